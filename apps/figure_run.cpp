// apps/figure_run.cpp: the pieces of `evaluate`, for one frame.
#include "apps/figure_run.h"

#include <algorithm>
#include <cmath>

#include "apps/evaluate_depth.h"
#include "apps/evaluate_folders.h"
#include "apps/evaluate_json.h"
#include "apps/evaluate_origin.h"
#include "apps/evaluate_points.h"
#include "apps/evaluate_series.h"
#include "core/error.h"
#include "eval/model_errors.h"
#include "io/message.h"
#include "mesh/mesh_reader.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

constexpr double kScanDots = 2.4;  // under the model's, so wider
constexpr int kScanStepPx = 3;     // every so many columns and rows of the depth become a point

int chooseFrame(const RunMomentOptions& options, const JudgedRun& run, const SequenceTruth& truth) {
  const std::vector<int> frames = framesToJudge(run, truth);
  if (frames.empty())
    throw InputError(
        shown(run.folder) +
        ": no frame has both a model and a true mesh; reconstruct with --save-every 1");
  if (options.frame < 0) return frames.back();
  if (std::binary_search(frames.begin(), frames.end(), options.frame)) return options.frame;
  std::string some;
  for (std::size_t i = 0; i < std::min<std::size_t>(frames.size(), 8); ++i)
    some += std::to_string(frames[i]) + ", ";
  throw OptionError(say("--frame is ", options.frame,
                        ", but a model and a true mesh are there for frames ", some, "up to ",
                        frames.back()));
}

TriangleMesh scanOf(const Raster<float>& depth_mm, const PinholeCamera& left) {
  TriangleMesh scan;
  for (int v = 0; v < depth_mm.height_px; v += kScanStepPx)
    for (int u = 0; u < depth_mm.width_px; u += kScanStepPx)
      if (std::isfinite(depth_mm.at(u, v)))
        scan.vertices_mm.push_back(liftPixel<double>(left, u, v, depth_mm.at(u, v)).cast<float>());
  return scan;
}

/// What trueDepth() reads, or computes from.
std::filesystem::path depthSource(const SequenceTruth& truth, int frame) {
  const auto file = truth.depths.find(frame);
  return file == truth.depths.end() ? truth.meshes.at(frame) : file->second;
}

/// NaN where the scope doesn't see the point.
void dropUnobserved(const ModelErrors& errors, std::vector<double>& values) {
  for (std::size_t i = 0; i < errors.each_observed.size(); ++i)
    if (errors.each_observed[i] == 0) values[i] = std::nan("");
}

SurfaceErrorMap errorMapOf(ModelErrors& errors, const RunMomentOptions& options) {
  if (options.observed_only) {
    dropUnobserved(errors, errors.each_mm);
    dropUnobserved(errors, errors.each_signed_mm);
  }
  return colourErrors(errors.each_mm, errors.each_signed_mm, options.errors);
}

}  // namespace

Json addRunMoment(const RunMomentOptions& options, SceneInputs& inputs, FigureFoot& foot) {
  const JudgedRun run = openJudgedRun(options.run);
  const SequenceTruth truth = openSequenceTruth(options.sequence);
  requireSameSequence(run, truth);
  for (const std::string& warning : checkOrigin(run, truth)) inputs.warn(warning);
  const int frame = chooseFrame(options, run, truth);
  const Eigen::Isometry3d world_from_left =
      truth.trajectory[static_cast<std::size_t>(frame)].world_from_left;
  const Eigen::Isometry3d left_from_world = world_from_left.inverse();

  TriangleMesh mesh = readMesh(truth.meshes.at(frame));
  const Raster<float> depth_mm = trueDepth(truth, frame, mesh);
  TriangleMesh model;
  model.vertices_mm = movePoints(truthFromRun(run, truth).at(frame),
                                 readModel(run.models.at(frame)).model.positions_mm);
  const TriangleTree surface(mesh);
  ModelErrors errors =
      modelErrors(model.vertices_mm, {surface, depth_mm, truth.rig, world_from_left});
  mesh.vertices_mm = movePoints(left_from_world, mesh.vertices_mm);
  model.vertices_mm = movePoints(left_from_world, model.vertices_mm);

  inputs.scene().frame = SceneFrame::kCamera;
  inputs.addMade({"true surface", std::move(mesh), {170, 170, 170}, {}}, "reference",
                 truth.meshes.at(frame));
  SceneSurface& scan =
      inputs.addMade({"scan of this frame", scanOf(depth_mm, truth.rig.left), kScanRed, {}}, "scan",
                     depthSource(truth, frame));
  scan.dot_scale = kScanDots;
  scan.in_3d = options.errors.kind == "none";
  SceneSurface& shown_model = inputs.addMade({"model", std::move(model), surfaceColour(1), {}},
                                             "model", run.models.at(frame));
  shown_model.in_focus = true;
  Json record{{"run", options.run}, {"sequence", options.sequence}, {"frame", frame}};
  record["left_from_true_world"] = matrixJson(left_from_world);
  record["observed_share"] = errors.observed_share;
  if (options.errors.kind != "none") {
    const SurfaceErrorMap map = errorMapOf(errors, options);
    shown_model.errors_mm = map.each_mm;
    map.explainIn(foot);
    record["errors"] = map.json;
    record["errors"]["alignment"] = "by the true pose of the camera";
    record["errors"]["points"] = options.observed_only ? "seen now" : "all";
  }
  return record;
}

}  // namespace softscope
