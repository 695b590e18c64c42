// toolkit/depth/measure_sequence.h: stereo pairs to depth in mm, with files and a record.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/sequences/sequence_paths.h"
#include "pipeline/run_options.h"
#include "toolkit/depth/depth_outputs.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_paths.h"

namespace softscope {

struct MeasureOptions {
  SequencePaths sequence;
  std::string name;                           // of the sequence in messages and titles
  std::map<std::string, std::string> inputs;  // by role, for the record
  bool numbered = false;                      // names of files begin with the frame, also of one
  DepthOptions settings;
  std::string backend = "auto";           // or cpu, cuda; auto measures one pair on the CPU
  std::optional<DepthOutputKinds> kinds;  // none: all of one pair, depth.png of several
  bool dense = false;                     // depth of every pixel besides
  std::optional<DepthRange> range;        // of the colour bar; none: of the first depth
  std::filesystem::path out;              // folder
  bool raw_left = false;                  // frame of the point cloud: as the camera took it
  bool overwrite = false;
  RecordPaths paths;

  /// Without a result in mm no calibration is needed.
  bool uncalibrated() const { return kinds && kinds->onlyPixels() && !dense; }
};

struct MeasuredSequence {
  FactSheet::Json record;          // of summary.json
  FactSheet facts{""};             // for people
  std::vector<std::string> files;  // what was written, for people
  bool interrupted = false;        // what was finished stays
};

/// "40:80", mm. Throws OptionError.
DepthRange parseDepthRange(const std::string& text);

/// `listener.progress` counts frames; one that can't be measured is a failure, and the others go
/// on. Throws OptionError; InputError where not one frame could be measured; BackendError.
MeasuredSequence measureSequence(MeasureOptions options, const WorkListener& listener = {});

}  // namespace softscope
