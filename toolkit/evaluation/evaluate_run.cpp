// toolkit/evaluation/evaluate_run.cpp: evaluation by the kind of reference.
#include "toolkit/evaluation/evaluate_run.h"

#include <filesystem>

#include "core/error.h"
#include "io/files/file_hash.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "toolkit/evaluation/evaluate_frames.h"
#include "toolkit/evaluation/evaluate_plots.h"
#include "toolkit/evaluation/evaluate_record.h"
#include "toolkit/export/export_input.h"
#include "toolkit/run/provenance.h"
#include "vtk_views/drawing/fonts.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

constexpr const char* kSurface = "surface";  // part of the record for metrics without path
constexpr const char* kView = "view";        // the same for an evaluation without truth

enum class ReferenceKind { kTruth, kSequence, kMesh, kMaps };

ReferenceKind kindOf(const EvaluateOptions& options) {
  if (holdsDepthMaps(options.run)) return ReferenceKind::kMaps;
  if (!isFolder(options.reference)) return ReferenceKind::kMesh;
  return hasTruth(options.reference) ? ReferenceKind::kTruth : ReferenceKind::kSequence;
}

/// Progress over a series of `total` models.
AfterModel counting(const Progress& progress, std::size_t total) {
  const auto count = static_cast<int>(total);
  reportProgress(progress, 0, count);
  return [&progress, count, done = 0]() mutable { return reportProgress(progress, ++done, count); };
}

EvaluationResult againstSequence(const EvaluateOptions& options, const JudgedRun& run,
                                 const Progress& progress) {
  const SequenceTruth truth = openSequenceTruth(options.reference);
  requireSameSequence(run, truth);
  const std::vector<std::string> origin = checkOrigin(run.folder, truth);
  EvaluationResult result;
  result.outcomes = run.outcomes;
  for (const int frame : run.frames)
    result.times_s[frame] = truth.poses.count(frame) == 0 ? run.timeOf(frame) : truth.timeOf(frame);
  result.camera = judgeCamera(run, truth);
  const std::vector<TrackSample> true_tracks = readTrueTracks(truth);
  result.tracks = judgeTracks(run, truth, true_tracks);
  result.backprojection_mm = run.backprojection_mm;
  const auto frames = framesToJudge(run, truth);
  result.surface = judgeSeries(run, truth, options.views, counting(progress, frames.size()));
  result.revisits = judgeRevisits(run, truth, result);
  result.judged_frames = judgeClaims(run, true_tracks, result);
  if (options.views && !result.surface.interrupted) result.held_out = judgeHeldOut(run, truth);
  result.warnings = run.warnings();
  for (std::string& warning : heldOutWarnings(result.held_out))
    result.warnings.push_back(std::move(warning));
  for (std::string& warning : sequenceWarnings(run, truth, result))
    result.warnings.push_back(std::move(warning));
  result.warnings.insert(result.warnings.end(), origin.begin(), origin.end());
  return result;
}

FrameFiles modelsFor(const EvaluateOptions& options, const JudgedRun& run) {
  if (options.each_model && run.countedModels().empty())
    throw InputError(
        shown(run.folder / "models") +
        ": holds no model NNNNNN.ply of a fused frame, but `each_model=` asks for them; "
        "reconstruct with `save_every=` 1");
  if (options.each_model) return run.countedModels();
  if (options.frame >= 0) {
    const std::filesystem::path file = savedModel(options.run, options.frame).file;
    if (!run.counts(options.frame))
      throw InputError(say(options.run, ": frame ", options.frame,
                           " was not fused: its model is that of an earlier frame; give a frame "
                           "with the status fused in frames.csv"));
    return {{options.frame, file}};
  }
  if (run.last_model.empty())
    throw InputError(
        shown(run.folder / "model.ply") +
        ": is missing, but required for the comparison with a mesh; reconstruct again");
  return {{run.lastCounted(), run.last_model}};
}

EvaluationResult againstMesh(const EvaluateOptions& options, const JudgedRun& run,
                             const Progress& progress) {
  const FrameFiles models = modelsFor(options, run);
  const TriangleMesh mesh = readMesh(options.reference, {options.reference_unit_mm});
  EvaluationResult result;
  result.against_mesh = true;
  result.warnings = run.warnings();
  result.outcomes = run.outcomes;
  for (const int frame : run.frames) result.times_s[frame] = run.timeOf(frame);
  result.alignment = options.alignment;
  for (const std::string& warning : meshWarnings(checkMesh(mesh), "--reference-unit-mm"))
    result.warnings.push_back(options.reference + ": " + warning);
  AlignedSeries series =
      judgeAgainstMesh(run, models, mesh, options.alignment, counting(progress, models.size()));
  result.surface = std::move(series.surface);
  result.alignments = std::move(series.alignments);
  return result;
}

/// Hashes of run.json, with the inputs of the run, and of a mesh; a sequence is too large.
Json hashesOf(const EvaluateOptions& options) {
  Json hashes = Json::object();
  const fs::path record = fs::path(options.run) / "run.json";
  if (isThere(record)) hashes["run"] = sha256Of(record);
  if (!isFolder(options.reference)) hashes["reference"] = sha256Of(options.reference);
  return hashes;
}

RunEvaluation interrupted() {
  RunEvaluation evaluation;
  evaluation.interrupted = true;
  return evaluation;
}

/// Record with its thresholds and `details`; metrics without a path are searched in `part`.
template <class Result>
RunEvaluation finished(const EvaluateOptions& options, const char* part, Json record,
                       const Json& details, const FactSheet& facts, Result result) {
  RunEvaluation evaluation;
  evaluation.outcomes = checkThresholds(options.thresholds, record, part);
  record["thresholds"] = thresholdsJson(evaluation.outcomes);
  record["figures"] = {{"font", figureFont()}};
  record.update(details);
  evaluation.record = options.paths.applyTo(record);
  evaluation.facts = facts;
  evaluation.result = std::move(result);
  return evaluation;
}

RunEvaluation withoutTruth(const EvaluateOptions& options, const JudgedRun& run,
                           const Progress& progress) {
  TruthlessResult result = judgeWithoutTruth(run, options.reference, options.views,
                                             counting(progress, run.countedModels().size()));
  if (result.interrupted) return interrupted();
  result.run = options.run;
  result.sequence = options.reference;
  const Json record = truthlessJson(result), details{{"inputs_sha256", hashesOf(options)}};
  const FactSheet facts = truthlessFacts(result);
  return finished(options, kView, record, details, facts, std::move(result));
}

DepthMapOptions mapOptionsOf(const EvaluateOptions& options) {
  return {options.run, options.reference, options.map_kind, options.calibration,
          options.confidence};
}

/// Part of the record in which metrics of maps without a path are searched.
const char* mapPart(const DepthMapOptions& options) {
  return options.mapKind() == MapKind::kDepth ? "depth" : "disparity";
}

RunEvaluation ofMaps(const EvaluateOptions& options, const Progress& progress) {
  const DepthMapOptions maps = mapOptionsOf(options);
  DepthMapResult result = judgeDepthMaps(maps, progress);
  if (result.interrupted) return interrupted();
  const Json record = depthMapJson(result);
  const FactSheet facts = depthMapFacts(result);
  return finished(options, mapPart(maps), record, Json::object(), facts, std::move(result));
}

RunEvaluation withTruth(const EvaluateOptions& options, EvaluationResult result) {
  if (result.surface.interrupted) return interrupted();
  result.run = options.run;
  result.reference = options.reference;
  const Json record = evaluationJson(result);
  const FactSheet facts = evaluationFacts(result);
  const Json details{{"error_histogram", histogramJson(result.surface.pool.all_mm())},
                     {"frames", frameTable(result).json()},
                     {"inputs_sha256", hashesOf(options)}};
  return finished(options, kSurface, record, details, facts, std::move(result));
}

void validateMaps(const EvaluateOptions& options) {
  if (options.alignment != MeshAlignment::kNone || options.each_model)
    throw OptionError(
        "`align=` and `each_model=` are for a mesh; maps are compared pixel by pixel");
  checkThresholds(options.thresholds, depthMapJson({}), mapPart(mapOptionsOf(options)));
}

}  // namespace

MeshAlignment meshAlignmentNamed(const std::string& name, const std::string& option) {
  for (const MeshAlignment kind :
       {MeshAlignment::kNone, MeshAlignment::kRigid, MeshAlignment::kIcp})
    if (name == toString(kind)) return kind;
  throw OptionError(option + " is `" + name + "`, but must be none, rigid or icp");
}

void EvaluateOptions::validate() const {
  const ReferenceKind kind = kindOf(*this);
  if (kind == ReferenceKind::kMaps) return validateMaps(*this);
  if (!map_kind.empty() || !calibration.empty() || !confidence.empty())
    throw OptionError("`map_kind=`, `calibration=` and `confidence=` are of depth maps, but " +
                      run + " is none and no folder of them");
  if (kind != ReferenceKind::kMesh && (alignment != MeshAlignment::kNone || each_model))
    throw OptionError(
        "`align=` and `each_model=` are for a mesh; a sequence is compared frame by frame, "
        "in its camera's frame, with no alignment");
  if (frame >= 0 && (kind != ReferenceKind::kMesh || each_model))
    throw OptionError(
        "`frame=` is for a mesh without `each_model=`; a sequence is compared frame by frame");
  EvaluationResult empty;
  empty.against_mesh = kind == ReferenceKind::kMesh;
  const bool truthless = kind == ReferenceKind::kSequence;
  TruthlessResult none;
  none.held_out.every = empty.held_out.every = holdOutEvery(run);
  checkThresholds(thresholds, truthless ? truthlessJson(none) : evaluationJson(empty),
                  truthless ? kView : kSurface);
}

RunEvaluation evaluateRun(const EvaluateOptions& options, const Progress& progress) {
  options.validate();
  const ReferenceKind kind = kindOf(options);
  if (kind == ReferenceKind::kMaps) return ofMaps(options, progress);
  const JudgedRun run = openJudgedRun(options.run);
  if (kind == ReferenceKind::kSequence) return withoutTruth(options, run, progress);
  return withTruth(options, kind == ReferenceKind::kMesh ? againstMesh(options, run, progress)
                                                         : againstSequence(options, run, progress));
}

}  // namespace softscope
