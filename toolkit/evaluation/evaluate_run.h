// toolkit/evaluation/evaluate_run.h: evaluation of a run folder or of maps.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/length_unit.h"
#include "toolkit/evaluation/depth_map_result.h"
#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/evaluation/truthless_result.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_paths.h"

namespace softscope {

struct EvaluateOptions {
  std::string run;        // folder written by reconstructSequence(), or a map, or a folder of maps
  std::string reference;  // sequence folder, best with groundtruth/, or a mesh; for maps: true maps
  MeshAlignment alignment = MeshAlignment::kNone;  // of a mesh
  bool each_model = false;                         // for a mesh: all models instead of the last
  int frame = -1;                                  // for a mesh: model of this frame; -1: last
  double reference_unit_mm = kUnitOfFile;          // for a mesh file: 1000 for metres
  bool views = true;                               // render each model for depth, PSNR and SSIM
  std::string map_kind, calibration, confidence;   // for maps only: DepthMapOptions
  std::vector<Threshold> thresholds;
  RecordPaths paths;

  /// Throws OptionError: an option excluded by the kind of reference, an unknown metric.
  void validate() const;
};

/// none, rigid or icp. Throws OptionError with the name of the option.
MeshAlignment meshAlignmentNamed(const std::string& name, const std::string& option);

/// After an interruption, only `interrupted` is valid.
struct RunEvaluation {
  /// TruthlessResult: without ground truth. DepthMapResult: for maps.
  std::variant<EvaluationResult, TruthlessResult, DepthMapResult> result;
  std::vector<ThresholdOutcome> outcomes;
  FactSheet::Json record;  // content of evaluation.json
  FactSheet facts{""};     // summary as text
  bool interrupted = false;
};

/// Progress counts models or maps. Throws InputError, and OptionError as validate() does.
RunEvaluation evaluateRun(const EvaluateOptions& options, const Progress& progress = {});

}  // namespace softscope
