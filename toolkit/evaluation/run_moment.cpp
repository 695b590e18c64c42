// toolkit/evaluation/run_moment.cpp: the pieces of `evaluate`, for one frame.
#include "toolkit/evaluation/run_moment.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/message.h"
#include "mesh/mesh_reader.h"
#include "toolkit/evaluation/evaluate_depth.h"
#include "toolkit/evaluation/evaluate_series.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/provenance.h"

namespace softscope {
namespace {

constexpr int kScanStepPx = 3;  // every so many columns and rows of the depth become a point

TriangleMesh scanOf(const Raster<float>& depth_mm, const PinholeCamera& left) {
  TriangleMesh scan;
  for (int v = 0; v < depth_mm.height_px; v += kScanStepPx)
    for (int u = 0; u < depth_mm.width_px; u += kScanStepPx)
      if (std::isfinite(depth_mm.at(u, v)))
        scan.vertices_mm.push_back(liftPixel<double>(left, u, v, depth_mm.at(u, v)).cast<float>());
  return scan;
}

/// NaN where the scope doesn't see the point.
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
  warnings = checkOrigin(run, truth);
  if (frames().empty())
    throw InputError(
        shown(run.folder) +
        ": no fused frame has both a model and a true mesh; reconstruct with --save-every 1");
}

std::vector<int> JudgedPair::frames() const { return framesToJudge(run, truth); }

int JudgedPair::chooseFrame(int wanted) const {
  const std::vector<int> there = frames();
  if (wanted < 0) return there.back();
  if (std::binary_search(there.begin(), there.end(), wanted)) return wanted;
  std::string some;
  for (std::size_t i = 0; i < std::min<std::size_t>(there.size(), 8); ++i)
    some += std::to_string(there[i]) + ", ";
  throw OptionError(say("--frame is ", wanted,
                        ", but fused, with a model and a true mesh, are the frames ", some,
                        "up to ", there.back()));
}

RunMoment JudgedPair::moment(int frame) const {
  const TimedPose& pose = truth.trajectory[static_cast<std::size_t>(frame)];
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
  if (file.coloured) moment.model.colours = std::move(file.model.colours);
  moment.model.vertices_mm =
      movePoints(truthFromRun(run, truth).at(frame), file.model.positions_mm);
  const TriangleTree surface(moment.truth);
  moment.errors =
      modelErrors(moment.model.vertices_mm, {surface, depth_mm, truth.rig, pose.world_from_left});
  for (TriangleMesh* mesh : {&moment.truth, &moment.model})
    mesh->vertices_mm = movePoints(moment.left_from_true_world, mesh->vertices_mm);
  moment.scan = scanOf(depth_mm, truth.rig.left);
  return moment;
}

}  // namespace softscope
