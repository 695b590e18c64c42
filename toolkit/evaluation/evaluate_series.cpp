// toolkit/evaluation/evaluate_series.cpp: reads ahead, judges, sums up.
#include "toolkit/evaluation/evaluate_series.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "eval/statistics/error_series.h"
#include "io/text/message.h"
#include "mesh/mesh_reader.h"
#include "toolkit/evaluation/evaluate_depth.h"
#include "toolkit/run/model_file.h"

namespace softscope {
namespace {

/// What one frame is judged by, in the true world.
struct Moment {
  ModelFile file;                          // in the run's world
  std::vector<Eigen::Vector3f> points_mm;  // in the true one
  TriangleMesh mesh;
  std::unique_ptr<TriangleTree> surface;
  Raster<float> depth_mm;
  Eigen::Isometry3d world_from_left;
};

Moment readMoment(const JudgedRun& run, const SequenceTruth& truth, int frame,
                  const Eigen::Isometry3d& truth_from_run) {
  Moment moment;
  moment.file = readModel(run.models.at(frame));
  moment.points_mm = movePoints(truth_from_run, moment.file.model.positions_mm);
  moment.mesh = readMesh(truth.meshes.at(frame));
  moment.surface = std::make_unique<TriangleTree>(moment.mesh);
  moment.depth_mm = trueDepth(truth, frame, moment.mesh);
  moment.world_from_left = truth.poses.at(frame).world_from_left;
  return moment;
}

JudgedModel& keep(int frame, double time_s, ModelErrors errors, const std::vector<float>& sigmas_mm,
                  SurfaceSeries& series) {
  series.pool.add(errors, sigmas_mm);
  errors.each_mm = {};
  errors.each_signed_mm = {};
  errors.each_observed = {};
  errors.each_beyond = {};
  series.models.push_back({frame, time_s, std::move(errors), std::nullopt});
  return series.models.back();
}

JudgedSigma judgeSigma(const std::vector<double>& errors_mm, const std::vector<double>& sigmas_mm) {
  JudgedSigma judged;
  judged.intervals = intervalCoverage(errors_mm, sigmas_mm);
  judged.sparse = sparsification(errors_mm, sigmas_mm);
  if (!errors_mm.empty())
    judged.known_share =
        static_cast<double>(judged.intervals.count) / static_cast<double>(errors_mm.size());
  return judged;
}

void sumUp(SurfaceSeries& series) {
  series.all_mm = statistics(series.pool.all_mm());
  series.signed_mm = statistics(series.pool.signed_mm());
  series.observed_mm = statistics(series.pool.observed_mm());
  series.predicted_mm = statistics(series.pool.predicted_mm());
  series.all_sigma = judgeSigma(series.pool.all_mm(), series.pool.all_sigma_mm());
  series.observed_sigma = judgeSigma(series.pool.observed_mm(), series.pool.observed_sigma_mm());
  series.predicted_sigma = judgeSigma(series.pool.predicted_mm(), series.pool.predicted_sigma_mm());
  std::vector<double> times_s, frames, means_mm;
  for (const JudgedModel& model : series.models) {
    times_s.push_back(model.time_s);
    frames.push_back(model.frame);
    means_mm.push_back(model.errors.distance_mm.mean);
  }
  series.drift_mm_per_s = theilSenSlope(times_s, means_mm);
  series.drift_mm_per_frame = theilSenSlope(frames, means_mm);
  series.second_differences_mm = secondDifferences(frames, means_mm);
  series.jitter_rms_mm = statistics(series.second_differences_mm).rmse;
}

}  // namespace

double SurfaceSeries::meanOfView(const std::function<double(const ViewErrors&)>& value) const {
  std::vector<double> values;
  for (const JudgedModel& model : models)
    if (model.view) values.push_back(value(*model.view));
  return statistics(values).mean;
}

double SurfaceSeries::meanOf(const std::function<double(const ModelErrors&)>& value) const {
  std::vector<double> values;
  for (const JudgedModel& model : models) values.push_back(value(model.errors));
  return statistics(values).mean;
}

std::vector<int> framesToJudge(const JudgedRun& run, const SequenceTruth& truth) {
  std::vector<int> frames;
  for (const auto& [frame, file] : run.countedModels())
    if (truth.meshes.count(frame) != 0 && truth.poses.count(frame) != 0) frames.push_back(frame);
  return frames;
}

SurfaceSeries judgeSeries(const JudgedRun& run, const SequenceTruth& truth, bool views,
                          const AfterModel& after_model) {
  const std::vector<int> frames = framesToJudge(run, truth);
  const auto moves = truthFromRun(run, truth);
  std::optional<ViewJudge> view_judge;
  if (views) view_judge.emplace(truth);
  SurfaceSeries series;
  series.pool = ErrorPool(frames.size());
  ErrorMaps maps(frames.size());
  const auto read = [&](std::size_t i) {
    return readMoment(run, truth, frames[i], moves.at(frames[i]));
  };
  std::optional<Moment> next;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Moment now = next ? std::move(*next) : read(i);
    next.reset();
    ModelErrors errors;
    std::optional<ViewErrors> view;
    parallelInvoke(
        [&] {
          errors = modelErrors(now.points_mm,
                               {*now.surface, now.depth_mm, truth.rig, now.world_from_left},
                               kCompletenessMm);
        },
        [&] {
          const Eigen::Isometry3d run_from_left =
              moves.at(frames[i]).inverse() * now.world_from_left;
          if (view_judge)
            view = view_judge->judge(now.file, run_from_left, frames[i], now.depth_mm);
          if (i + 1 < frames.size()) next = read(i + 1);
        });
    const double time_s = truth.timeOf(frames[i]);
    maps.add(frames[i], time_s, now.points_mm, errors, now.mesh, now.world_from_left);
    keep(frames[i], time_s, std::move(errors), now.file.sigmas_mm, series).view = std::move(view);
    if (!after_model()) {
      series.interrupted = true;
      return series;
    }
  }
  series.maps = maps.kept();
  sumUp(series);
  return series;
}

AlignedSeries judgeAgainstMesh(const JudgedRun& run, const FrameFiles& models,
                               const TriangleMesh& mesh, MeshAlignment alignment,
                               const AfterModel& after_model) {
  const TriangleTree surface(mesh);
  const Raster<float> no_depth;
  const RectifiedRig no_rig;
  AlignedSeries result;
  result.surface.pool = ErrorPool(models.size());
  ErrorMaps maps(models.size());
  Eigen::Isometry3d mesh_from_run = Eigen::Isometry3d::Identity();
  for (const auto& [frame, file] : models) {
    const ModelFile read = readModel(file);
    const std::vector<Eigen::Vector3f>& points_mm = read.model.positions_mm;
    const bool first = result.alignments.empty();
    if (alignment == MeshAlignment::kIcp || (alignment == MeshAlignment::kRigid && first)) {
      result.alignments.push_back(alignToSurface(points_mm, surface, {}, mesh_from_run));
      mesh_from_run = result.alignments.back().surface_from_points;
    }
    const std::vector<Eigen::Vector3f> moved_mm = movePoints(mesh_from_run, points_mm);
    ModelErrors errors = modelErrors(moved_mm, {surface, no_depth, no_rig, {}});
    maps.add(frame, run.timeOf(frame), moved_mm, errors, mesh, mesh_from_run);
    keep(frame, run.timeOf(frame), std::move(errors), read.sigmas_mm, result.surface);
    if (!after_model()) {
      result.surface.interrupted = true;
      return result;
    }
  }
  result.surface.maps = maps.kept();
  sumUp(result.surface);
  return result;
}

}  // namespace softscope
