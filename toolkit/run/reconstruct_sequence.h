// toolkit/run/reconstruct_sequence.h: a stereo sequence to a run folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/sequences/sequence_paths.h"
#include "pipeline/run_options.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_paths.h"

namespace softscope {

struct ReconstructOptions {
  SequencePaths sequence;
  std::string name;  // of the sequence in messages
  RunOptions settings;
  std::string backend = "auto";       // or cpu, cuda
  std::filesystem::path tracks;       // CSV id,u_px,v_px of the first left image; empty: none
  std::filesystem::path out;          // folder of the run
  int save_every = 10;                // frames between saved models; 0: only the last
  int checkpoint_every = 100;         // frames after which all files are brought up to date
  bool resume = false;                // go on with an interrupted run
  bool overwrite = false;             // replace an earlier run
  std::vector<Threshold> thresholds;  // of run.json; a bare metric is one of `outcomes`
  RecordPaths paths;

  /// Throws OptionError.
  void validate() const;
};

struct ReconstructedRun {
  FactSheet::Json record;  // of run.json
  FactSheet facts{""};     // for people
  std::vector<ThresholdOutcome> outcomes;
  bool interrupted = false;
};

/// `listener.progress` counts frames; a stopped run can be resumed. Frames that are not fused are
/// warnings. Throws OptionError; InputError where not one frame could be used, or the sequence was
/// removed meanwhile; BackendError.
ReconstructedRun reconstructSequence(ReconstructOptions options, const WorkListener& listener = {});

}  // namespace softscope
