// toolkit/evaluation/run_moment.cpp: evaluation of a single frame.
#include "toolkit/evaluation/run_moment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/error.h"
#include "io/text/message.h"
#include "mesh/mesh_reader.h"
#include "toolkit/evaluation/evaluate_depth.h"
#include "toolkit/evaluation/evaluate_series.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/model_surface.h"
#include "toolkit/run/provenance.h"

namespace softscope {
namespace {

constexpr int kScanStepPx = 3;  // distance of columns and rows of depth that become points

/// Limit of the depth difference of neighbours on one surface, as a multiple of their distance.
constexpr double kSteepest = 3;

TriangleMesh scanOf(const Raster<float>& depth_mm, const PinholeCamera& left) {
  TriangleMesh scan;
  const int columns = (depth_mm.width_px + kScanStepPx - 1) / kScanStepPx;
  const int rows = (depth_mm.height_px + kScanStepPx - 1) / kScanStepPx;
  std::vector<std::int32_t> vertex_at(static_cast<std::size_t>(columns * rows), -1);
  const auto at = [&](int i, int j) {
    return vertex_at[static_cast<std::size_t>(j * columns + i)];
  };
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    if (a < 0 || b < 0 || c < 0) return;
    float nearest = std::numeric_limits<float>::max(), farthest = 0;
    for (const std::int32_t k : {a, b, c}) {
      nearest = std::min(nearest, scan.vertices_mm[static_cast<std::size_t>(k)].z());
      farthest = std::max(farthest, scan.vertices_mm[static_cast<std::size_t>(k)].z());
    }
    if (farthest - nearest < kSteepest * kScanStepPx * nearest / left.fx_px)
      scan.triangles.push_back({a, b, c});
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int u = i * kScanStepPx, v = j * kScanStepPx;
      if (!std::isfinite(depth_mm.at(u, v))) continue;
      vertex_at[static_cast<std::size_t>(j * columns + i)] =
          static_cast<std::int32_t>(scan.vertices_mm.size());
      scan.vertices_mm.push_back(liftPixel<double>(left, u, v, depth_mm.at(u, v)).cast<float>());
    }
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      add(at(i, j), at(i, j + 1), at(i + 1, j));
      add(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  return scan;
}

/// NaN for points that the scope does not see.
std::vector<double> onlyObserved(std::vector<double> values, const ModelErrors& errors) {
  for (std::size_t i = 0; i < errors.each_observed.size(); ++i)
    if (errors.each_observed[i] == 0) values[i] = std::nan("");
  return values;
}

}  // namespace

std::vector<double> RunMoment::distances(bool observed_only) const {
  return observed_only ? onlyObserved(errors.each_mm, errors) : errors.each_mm;
}

std::vector<double> RunMoment::signedDistances(bool observed_only) const {
  return observed_only ? onlyObserved(errors.each_signed_mm, errors) : errors.each_signed_mm;
}

JudgedPair::JudgedPair(const std::string& run_folder, const std::string& sequence)
    : run(openJudgedRun(run_folder)), truth(openSequenceTruth(sequence)) {
  requireSameSequence(run, truth);
  warnings = checkOrigin(run.folder, truth);
  if (frames().empty())
    throw InputError(shown(run.folder) +
                     ": no frame has both a model of a fused frame and a true mesh; reconstruct "
                     "with `save_every=` 1");
}

std::vector<int> JudgedPair::frames() const { return framesToJudge(run, truth); }

int JudgedPair::chooseFrame(int wanted) const {
  const std::vector<int> there = frames();
  if (wanted < 0) return there.back();
  if (std::binary_search(there.begin(), there.end(), wanted)) return wanted;
  std::string some;
  for (std::size_t i = 0; i < std::min<std::size_t>(there.size(), 8); ++i)
    some += std::to_string(there[i]) + ", ";
  throw OptionError(say("`frame=` is ", wanted,
                        ", but fused, with a model and a true mesh, are the frames ", some,
                        "up to ", there.back()));
}

std::string momentText(int frame, double time_s) {
  if (!std::isfinite(time_s)) return "frame " + std::to_string(frame);
  char text[64];
  std::snprintf(text, sizeof text, "frame %d, %.2f s", frame, time_s);
  return text;
}

RunMoment JudgedPair::moment(int frame, bool surface) const {
  const TimedPose& pose = truth.poses.at(frame);
  RunMoment moment;
  moment.frame = frame;
  moment.time_s = truth.timeOf(frame);
  moment.truth_file = truth.meshes.at(frame);
  moment.model_file = run.models.at(frame);
  const auto depth_file = truth.depths.find(frame);
  moment.scan_file = depth_file == truth.depths.end() ? moment.truth_file : depth_file->second;
  moment.left_from_true_world = pose.world_from_left.inverse();

  moment.truth = readMesh(moment.truth_file);
  const Raster<float> depth_mm = trueDepth(truth, frame, moment.truth);
  ModelFile file = readModel(moment.model_file);
  if (surface) moment.model = modelSurface(file);
  if (file.coloured) moment.model.colours = std::move(file.model.colours);
  moment.model.vertices_mm =
      movePoints(truthFromRun(run, truth).at(frame), file.model.positions_mm);
  const TriangleTree true_surface(moment.truth);
  moment.errors = modelErrors(moment.model.vertices_mm,
                              {true_surface, depth_mm, truth.rig, pose.world_from_left});
  for (TriangleMesh* mesh : {&moment.truth, &moment.model})
    mesh->vertices_mm = movePoints(moment.left_from_true_world, mesh->vertices_mm);
  moment.scan = scanOf(depth_mm, truth.rig.left);
  return moment;
}

}  // namespace softscope
