// apps/evaluate.cpp: `softscope evaluate`: how far a run is from the truth, frame by frame.
#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "apps/threshold_exit.h"
#include "core/error.h"
#include "io/file_hash.h"
#include "io/folder.h"
#include "io/message.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "toolkit/evaluation/depth_map_result.h"
#include "toolkit/evaluation/evaluate_outputs.h"
#include "toolkit/evaluation/evaluate_plots.h"
#include "toolkit/evaluation/evaluate_record.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/evaluation/truthless_result.h"
#include "toolkit/record/record_paths.h"
#include "toolkit/run/provenance.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

const char* const kDetails =
    "RUN is a folder that `reconstruct` wrote. Against a sequence with groundtruth/, every model\n"
    "whose frame has a true mesh is compared in the frame of that moment's camera: accuracy, "
    "split\n"
    "into observed and predicted points, signed distance, completeness, three HD95 by name, drift\n"
    "and jitter; tracks beside the no-motion control; the scope's path (ATE, RPE); the model "
    "drawn\n"
    "from the run's pose beside true depth and picture (PSNR, SSIM).\n"
    "Against a mesh (STL, PLY, OBJ; a CT's, say) the last model, or each one, is compared.\n"
    "Of a sequence without groundtruth/ it gives what needs no truth: PSNR and SSIM of the drawn\n"
    "model, back-projection, coverage, steps and jitter of the scope; and says what is missing.\n"
    "In the place of RUN a disparity or depth map, or a folder of maps, is judged against the "
    "true\n"
    "ones (--reference): EPE, bad-1, 2, 3, MAE and RMSE in mm, coverage; with --confidence "
    "whether\n"
    "predicted sigmas tell the errors (intervals, sparsification).\n"
    "With --out DIR it writes evaluation.json, frames.csv, tracks.csv, and the figures\n"
    "error_series, error_histogram and worst_frames as SVG, PDF and PNG; errors.pvd shows the\n"
    "error of every point in ParaView, `softscope report DIR` makes a page of it all.\n"
    "docs/evaluation.md defines every value.\n"
    "--fail-if METRIC>LIMIT ends with exit code 1 where that holds, or the metric isn't known;\n"
    "METRIC is a path in evaluation.json (surface.observed.p95_mm), or its last part.";

constexpr const char* kPreferred = "surface";  // where --fail-if looks for a bare name

class EvaluateCommand : public Command {
 public:
  std::string name() const override { return "evaluate"; }
  std::string summary() const override {
    return "a run against ground truth or a mesh: errors over time";
  }
  std::string details() const override { return kDetails; }
  std::string example() const override {
    return "softscope evaluate run --reference phantom --out evaluation --fail-if 'p95_mm>2'";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  MeshAlignment alignment() const;
  EvaluationResult againstSequence(const JudgedRun& run);
  EvaluationResult againstMesh(const JudgedRun& run);
  int besidePictures(const JudgedRun& run, const EvaluateOutputs* outputs);
  int judgeMaps();
  FactSheet::Json hashes() const;
  FrameFiles modelsFor(const JudgedRun& run) const;
  int finish(EvaluationResult result, const EvaluateOutputs* outputs);

  std::string run_, reference_, out_, align_ = "none";
  DepthMapOptions maps_;
  std::vector<std::string> fail_if_;
  double unit_mm_ = 1;
  RecordPaths paths_;
  bool each_ = false, force_ = false, no_views_ = false;

  std::vector<Threshold> thresholds_;
  std::optional<InterruptGuard> interrupt_;
};

void EvaluateCommand::declare(ArgumentList& arguments) {
  arguments.positional("RUN", run_, "folder that reconstruct wrote; or maps of disparity or depth",
                       true);
  arguments.option("--reference", "PATH", reference_, "sequence, best with groundtruth/, or a mesh",
                   true);
  arguments.option("--out", "DIR", out_, "folder for the results; without it they are only told");
  arguments.option("--fail-if", "LIMIT", fail_if_, "e.g. p95_mm>2: then exit code 1; repeatable");
  arguments.option("--align", "HOW", align_,
                   "to a mesh: none (the default), rigid (one for all models), icp (each model)");
  arguments.option("--reference-unit-mm", "N", unit_mm_,
                   "what one unit of a mesh measures: 1000 for metres");
  arguments.option("--map", "KIND", maps_.kind,
                   "of maps whose names don't say it: disparity (px) or depth (mm)");
  arguments.option("--calibration", "FILE", maps_.calibration,
                   "of rectified views: errors of disparity maps in mm, too");
  arguments.option("--confidence", "PATH", maps_.confidence,
                   "confidence.png of `depth`, or a folder of them: judges predicted sigmas");
  softscope::declare(paths_, arguments);
  arguments.flag("--each", each_, "against a mesh: every model, not the last alone");
  arguments.flag("--no-views", no_views_,
                 "don't draw the model for depth, PSNR and SSIM: saves a fifth of the time");
  arguments.flag("--force", force_, "overwrite what is there");
}

MeshAlignment EvaluateCommand::alignment() const {
  for (const MeshAlignment kind :
       {MeshAlignment::kNone, MeshAlignment::kRigid, MeshAlignment::kIcp})
    if (align_ == toString(kind)) return kind;
  throw OptionError("--align is `" + align_ + "`, but must be none, rigid or icp");
}

int EvaluateCommand::run() {
  interrupt_.emplace();
  for (const std::string& text : fail_if_) thresholds_.push_back(parseThreshold(text));
  if (holdsDepthMaps(run_)) return judgeMaps();
  if (!maps_.kind.empty() || !maps_.calibration.empty() || !maps_.confidence.empty())
    throw OptionError("--map, --calibration and --confidence are of depth maps, but " + run_ +
                      " is none and no folder of them");
  const bool sequence = isFolder(reference_);
  if (sequence && (alignment() != MeshAlignment::kNone || each_))
    throw OptionError(
        "--align and --each are for a mesh; a sequence is compared frame by frame, "
        "in its camera's frame, with no alignment");
  const bool truthless = sequence && !hasTruth(reference_);
  EvaluationResult empty;
  empty.against_mesh = !sequence;
  checkThresholds(thresholds_, truthless ? truthlessJson({}) : evaluationJson(empty),
                  truthless ? "view" : kPreferred);  // a misspelt name is told before the work
  std::optional<EvaluateOutputs> outputs;
  if (!out_.empty()) outputs.emplace(out_, force_);

  const JudgedRun folder = openJudgedRun(run_);
  if (truthless) return besidePictures(folder, outputs ? &*outputs : nullptr);
  EvaluationResult result = sequence ? againstSequence(folder) : againstMesh(folder);
  if (result.surface.interrupted) {
    spdlog::warn("interrupted: nothing is written");
    return kInterrupted;
  }
  return finish(std::move(result), outputs ? &*outputs : nullptr);
}

int EvaluateCommand::judgeMaps() {
  if (alignment() != MeshAlignment::kNone || each_)
    throw OptionError("--align and --each are for a mesh; maps are compared pixel by pixel");
  maps_.measured = run_;
  maps_.reference = reference_;
  const char* preferred = maps_.mapKind() == MapKind::kDepth ? "depth" : "disparity";
  checkThresholds(thresholds_, depthMapJson({}), preferred);
  std::optional<EvaluateOutputs> outputs;
  if (!out_.empty()) outputs.emplace(out_, force_);
  const DepthMapResult result =
      judgeDepthMaps(maps_, [&](int, int) { return !interrupt_->requested(); });
  if (result.interrupted) {
    spdlog::warn("interrupted: nothing is written");
    return kInterrupted;
  }
  FactSheet::Json record = depthMapJson(result);
  const auto outcomes = checkThresholds(thresholds_, record, preferred);
  record["thresholds"] = thresholdsJson(outcomes);
  record = paths_.applyTo(record);
  if (outputs) outputs->write(result, record);
  printResult(record, depthMapFacts(result), {out_}, common.json);
  return exitCodeOf(outcomes);
}

EvaluationResult EvaluateCommand::againstSequence(const JudgedRun& folder) {
  const SequenceTruth truth = openSequenceTruth(reference_);
  requireSameSequence(folder, truth);
  const std::vector<std::string> origin = checkOrigin(folder, truth);
  EvaluationResult result;
  result.outcomes = folder.outcomes;
  for (const int frame : folder.frames) result.times_s[frame] = truth.timeOf(frame);
  result.camera = judgeCamera(folder, truth);
  result.tracks = judgeTracks(folder, truth);
  result.backprojection_mm = folder.backprojection_mm;
  const auto frames = framesToJudge(folder, truth);
  ProgressBar progress("evaluate", static_cast<int>(frames.size()), progressStyle(common.quiet),
                       std::cerr);
  result.surface = judgeSeries(folder, truth, !no_views_, [&] {
    progress.advance();
    return !interrupt_->requested();
  });
  result.revisits = judgeRevisits(folder, truth, result);
  result.warnings = folder.warnings();
  for (std::string& warning : sequenceWarnings(folder, truth, result))
    result.warnings.push_back(std::move(warning));
  result.warnings.insert(result.warnings.end(), origin.begin(), origin.end());
  return result;
}

int EvaluateCommand::besidePictures(const JudgedRun& folder, const EvaluateOutputs* outputs) {
  ProgressBar progress("evaluate", static_cast<int>(folder.countedModels().size()),
                       progressStyle(common.quiet), std::cerr);
  TruthlessResult result = judgeWithoutTruth(folder, reference_, !no_views_, [&] {
    progress.advance();
    return !interrupt_->requested();
  });
  if (result.interrupted) {
    spdlog::warn("interrupted: nothing is written");
    return kInterrupted;
  }
  result.run = run_;
  result.sequence = reference_;
  FactSheet::Json record = truthlessJson(result);
  const auto outcomes = checkThresholds(thresholds_, record, "view");
  record["thresholds"] = thresholdsJson(outcomes);
  record["inputs_sha256"] = hashes();
  record = paths_.applyTo(record);
  if (outputs != nullptr) outputs->write(result, record);
  printResult(record, truthlessFacts(result), {out_}, common.json);
  return exitCodeOf(outcomes);
}

/// Of run.json, which has those of the run's inputs, and of a mesh; a sequence has too many bytes.
FactSheet::Json EvaluateCommand::hashes() const {
  FactSheet::Json hashes = FactSheet::Json::object();
  const std::filesystem::path record = std::filesystem::path(run_) / "run.json";
  if (isThere(record)) hashes["run"] = sha256Of(record);
  if (!isFolder(reference_)) hashes["reference"] = sha256Of(reference_);
  return hashes;
}

FrameFiles EvaluateCommand::modelsFor(const JudgedRun& folder) const {
  if (each_ && folder.countedModels().empty())
    throw InputError(shown(folder.folder / "models") +
                     ": holds no model NNNNNN.ply of a fused frame, but --each asks for them; "
                     "reconstruct with --save-every 1");
  if (each_) return folder.countedModels();
  if (folder.last_model.empty())
    throw InputError(shown(folder.folder / "model.ply") +
                     ": is missing, but it is what a mesh is compared with; reconstruct again");
  return {{folder.lastCounted(), folder.last_model}};
}

EvaluationResult EvaluateCommand::againstMesh(const JudgedRun& folder) {
  const MeshAlignment how = alignment();
  const FrameFiles models = modelsFor(folder);
  const TriangleMesh mesh = readMesh(reference_, {unit_mm_});
  EvaluationResult result;
  result.against_mesh = true;
  result.warnings = folder.warnings();
  result.outcomes = folder.outcomes;
  for (const int frame : folder.frames) result.times_s[frame] = folder.timeOf(frame);
  result.alignment = how;
  for (const std::string& warning : meshWarnings(checkMesh(mesh)))
    result.warnings.push_back(reference_ + ": " + warning);
  ProgressBar progress("evaluate", static_cast<int>(models.size()),
                       each_ ? progressStyle(common.quiet) : ProgressBar::Style::kSilent,
                       std::cerr);
  AlignedSeries series = judgeAgainstMesh(folder, models, mesh, how, [&] {
    progress.advance();
    return !interrupt_->requested();
  });
  result.surface = std::move(series.surface);
  result.alignments = std::move(series.alignments);
  return result;
}

int EvaluateCommand::finish(EvaluationResult result, const EvaluateOutputs* outputs) {
  result.run = run_;
  result.reference = reference_;
  const FrameTable frames = frameTable(result);
  FactSheet::Json record = evaluationJson(result);
  const auto outcomes = checkThresholds(thresholds_, record, kPreferred);
  record["thresholds"] = thresholdsJson(outcomes);
  record["error_histogram"] = histogramJson(result.surface.pool.all_mm());
  record["frames"] = frames.json();
  record["inputs_sha256"] = hashes();
  record = paths_.applyTo(record);
  if (outputs != nullptr) outputs->write(result, frames, record);
  printResult(record, evaluationFacts(result), {out_}, common.json);
  return exitCodeOf(outcomes);
}

}  // namespace

std::unique_ptr<Command> makeEvaluateCommand() { return std::make_unique<EvaluateCommand>(); }

}  // namespace softscope
