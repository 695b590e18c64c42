// apps/evaluate.cpp: `softscope evaluate`: errors of a run, frame by frame.
#include <spdlog/spdlog.h>

#include <optional>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "apps/threshold_exit.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "io/files/folder.h"
#include "toolkit/evaluation/evaluate_outputs.h"
#include "toolkit/evaluation/evaluate_run.h"

namespace softscope {
namespace {

const char* const kEvaluateDetails =
    "RUN is a folder written by `reconstruct`. Against a sequence with groundtruth/, every model\n"
    "with a true mesh of its frame is compared in the camera frame of that time: accuracy, split\n"
    "into observed and predicted points, signed distance, completeness, three definitions of "
    "HD95,\n"
    "drift and jitter; tracks with the no-motion control; the camera path (ATE, RPE); the model\n"
    "rendered from the pose of the run against true depth and image (PSNR, SSIM).\n"
    "Against a mesh (STL, PLY, OBJ; for example from CT) the last model, or each one, is "
    "compared.\n"
    "A sequence without groundtruth/ gives the values that need no truth: PSNR and SSIM of the\n"
    "rendered model, back-projection, coverage, steps and jitter of the scope; missing values are\n"
    "listed.\n"
    "Instead of RUN, a disparity or depth map, or a folder of maps, is compared with true maps\n"
    "(--reference): EPE, bad-1, 2, 3, MAE and RMSE in mm, coverage; with --confidence also the\n"
    "quality of predicted sigmas (intervals, sparsification).\n"
    "--out DIR writes evaluation.json, frames.csv, tracks.csv, and the figures error_series,\n"
    "error_histogram and worst_frames as SVG, PDF and PNG; errors.pvd shows the error of every\n"
    "point in ParaView, `softscope report DIR` makes a report of them.\n"
    "docs/evaluation.md defines every value.\n"
    "--fail-if METRIC>LIMIT ends with exit code 1 if that is true, or if it was not measured;\n"
    "METRIC is a path in evaluation.json (surface.observed.p95_mm), or its last part.";

class EvaluateCommand : public Command {
 public:
  std::string name() const override { return "evaluate"; }
  std::string summary() const override {
    return "errors of a run against ground truth or a mesh, over time";
  }
  std::string details() const override { return kEvaluateDetails; }
  std::string example() const override {
    return "softscope evaluate run --reference phantom --out evaluation --fail-if 'p95_mm>2'";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  RunEvaluation evaluate(const InterruptGuard& interrupt) const;

  EvaluateOptions options_;
  std::string out_, align_ = "none";
  std::vector<std::string> fail_if_;
  bool force_ = false, no_views_ = false;
};

void EvaluateCommand::declare(ArgumentList& arguments) {
  arguments.positional("RUN", options_.run,
                       "folder written by reconstruct; or maps of disparity or depth", true);
  arguments.option("--reference", "PATH", options_.reference,
                   "sequence, preferably with groundtruth/, or a mesh", true);
  arguments.option("--out", "DIR", out_,
                   "folder for the results; without it they are only printed");
  arguments.option("--fail-if", "LIMIT", fail_if_, "e.g. p95_mm>2: then exit code 1; repeatable");
  arguments.option("--align", "HOW", align_,
                   "to a mesh: none (the default), rigid (one for all models), icp (each model)");
  arguments.option("--reference-unit-mm", "N", options_.reference_unit_mm,
                   "mm per unit of a mesh: 1000 for metres (default: as it states, else 1)");
  arguments.option("--map", "KIND", options_.map_kind,
                   "for maps with ambiguous names: disparity (px) or depth (mm)");
  arguments.option("--calibration", "FILE", options_.calibration,
                   "of rectified views: adds errors of disparity maps in mm");
  arguments.option("--confidence", "PATH", options_.confidence,
                   "confidence.png of `depth`, or a folder of them: evaluates predicted sigmas");
  softscope::declare(options_.paths, arguments);
  arguments.option("--frame", "N", options_.frame,
                   "against a mesh: the saved model of frame N instead of the last");
  arguments.flag("--each", options_.each_model, "against a mesh: every model instead of the last");
  arguments.flag("--no-views", no_views_,
                 "do not render the model for depth, PSNR and SSIM: saves a fifth of the time");
  arguments.flag("--force", force_, "overwrite existing files");
}

/// A single model needs no progress bar.
RunEvaluation EvaluateCommand::evaluate(const InterruptGuard& interrupt) const {
  const bool many = options_.each_model || isFolder(options_.reference);
  WorkProgress progress("evaluate", progressStyle(common.quiet || !many), interrupt);
  return evaluateRun(options_, progress.callback());
}

int EvaluateCommand::run() {
  const InterruptGuard interrupt;
  for (const std::string& text : fail_if_) options_.thresholds.push_back(parseThreshold(text));
  options_.alignment = meshAlignmentNamed(align_, "--align");
  options_.views = !no_views_;
  options_.validate();  // before the work
  std::optional<EvaluateOutputs> outputs;
  if (!out_.empty()) outputs.emplace(out_, force_);
  const RunEvaluation evaluation = evaluate(interrupt);
  if (evaluation.interrupted) {
    spdlog::warn("interrupted: nothing is written");
    return kInterrupted;
  }
  if (outputs) outputs->write(evaluation);
  printResult(evaluation.record, evaluation.facts, {out_}, common.json);
  return exitCodeOf(evaluation.outcomes);
}

}  // namespace

std::unique_ptr<Command> makeEvaluateCommand() { return std::make_unique<EvaluateCommand>(); }

}  // namespace softscope
