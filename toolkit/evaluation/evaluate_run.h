// toolkit/evaluation/evaluate_run.h: evaluation of a run folder or of maps.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "toolkit/evaluation/depth_map_result.h"
#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/evaluation/truthless_result.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_paths.h"

namespace softscope {

struct EvaluateOptions {
  std::string run;        // folder that reconstructSequence() wrote; or a map, a folder of maps
  std::string reference;  // sequence folder, best with groundtruth/, or a mesh file; of maps maps
  MeshAlignment alignment = MeshAlignment::kNone;  // of a mesh
  bool each_model = false;                         // of a mesh: all models, not the last alone
  int frame = -1;                                  // of a mesh: this frame's model; -1: the last
  double reference_unit_mm = 1;                    // of a mesh file: 1000 for metres
  bool views = true;                               // draw each model for depth, PSNR and SSIM
  std::string map_kind, calibration, confidence;   // of maps alone: DepthMapOptions
  std::vector<Threshold> thresholds;
  RecordPaths paths;

  /// Throws OptionError: an option that the reference excludes, a threshold of an unknown metric.
  void validate() const;
};

/// none, rigid or icp. Throws OptionError naming the option.
MeshAlignment meshAlignmentNamed(const std::string& name, const std::string& option);

/// Where it was interrupted, `interrupted` alone is right.
struct RunEvaluation {
  /// TruthlessResult: no truth beside the run. DepthMapResult: of maps.
  std::variant<EvaluationResult, TruthlessResult, DepthMapResult> result;
  std::vector<ThresholdOutcome> outcomes;
  FactSheet::Json record;  // of evaluation.json
  FactSheet facts{""};     // for people
  bool interrupted = false;
};

/// Progress counts models, or maps. Throws InputError, and OptionError as validate() does.
RunEvaluation evaluateRun(const EvaluateOptions& options, const Progress& progress = {});

}  // namespace softscope
