// toolkit/depth/measure_sequence.h: stereo pairs to depth in mm, with files and a record.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/sequences/sequence_paths.h"
#include "pipeline/options/run_options.h"
#include "toolkit/depth/depth_outputs.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_paths.h"

namespace softscope {

struct MeasureOptions {
  SequencePaths sequence;
  std::string name;                           // name of the sequence in messages and titles
  std::map<std::string, std::string> inputs;  // paths by role, for the record
  bool numbered = false;                      // file names begin with the frame, even for one
  DepthOptions settings;
  std::string backend = "auto";           // or cpu, cuda; auto: CPU for one pair
  std::optional<DepthOutputKinds> kinds;  // default: all for one pair, depth.png for several
  bool dense = false;                     // additionally depth of every pixel
  std::optional<DepthRange> range;        // of the colour bar; default: range of the first depth
  std::filesystem::path out;              // folder
  bool raw_left = false;                  // point cloud in the frame of the raw left camera
  bool overwrite = false;
  RecordPaths paths;

  /// No calibration is needed without output in mm.
  bool uncalibrated() const { return kinds && kinds->onlyPixels() && !dense; }
};

struct MeasuredSequence {
  FactSheet::Json record;          // content of summary.json
  FactSheet facts{""};             // summary as text
  std::vector<std::string> files;  // description of the output, as text
  bool interrupted = false;        // finished frames are kept
};

/// "40:80", mm. Throws OptionError.
DepthRange parseDepthRange(const std::string& text);

/// `listener.progress` counts frames; a failed frame is recorded and processing
/// continues. Throws OptionError; InputError if no frame could be measured; BackendError.
MeasuredSequence measureSequence(MeasureOptions options, const WorkListener& listener = {});

}  // namespace softscope
