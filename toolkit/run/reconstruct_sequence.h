// toolkit/run/reconstruct_sequence.h: run folder from a stereo sequence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/sequences/sequence_paths.h"
#include "pipeline/options/run_options.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_paths.h"
#include "toolkit/run/run_folder.h"

namespace softscope {

struct ReconstructOptions {
  SequencePaths sequence;
  std::string name;  // name of the sequence in messages
  RunOptions settings;
  std::string backend = "auto";  // or cpu, cuda
  std::filesystem::path tracks;  // CSV id,u_px,v_px in the first left image; empty: none
  std::filesystem::path out;     // folder of the run
  int save_every = 10;           // frames between saved models; 0: only the last model
  int checkpoint_every = kCheckpointFrames;
  bool resume = false;                // continue an interrupted run
  bool overwrite = false;             // replace an earlier run
  std::vector<Threshold> thresholds;  // on run.json; metrics without a path are those of `outcomes`
  RecordPaths paths;
  std::vector<std::string> command_line;  // for run.json, without the program; empty: none

  /// Throws OptionError.
  void validate() const;
};

struct ReconstructedRun {
  FactSheet::Json record;  // content of run.json
  FactSheet facts{""};     // summary as text
  std::vector<ThresholdOutcome> outcomes;
  bool interrupted = false;
};

/// `listener.progress` counts frames; a stopped run can be resumed. Frames
/// that are not fused cause warnings. Throws OptionError; InputError if no
/// frame was usable, or the sequence was deleted during the run; BackendError.
ReconstructedRun reconstructSequence(ReconstructOptions options, const WorkListener& listener = {});

}  // namespace softscope
