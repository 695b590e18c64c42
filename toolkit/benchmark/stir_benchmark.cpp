#include "toolkit/benchmark/stir_benchmark.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "io/datasets/stir_files.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/sequences/dataset_form.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/record/json_text.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool isStirClip(const fs::path& folder) {
  return isFile(folder / "calib.json") && isFile(folder / "annotations.json");
}

/// Cameras of a clip; the truth is in the frame of the raw left camera.
struct ClipCameras {
  StereoCalibration calibration;
  Eigen::Matrix3d raw_from_rectified = Eigen::Matrix3d::Identity();

  /// Pinhole camera and disparity along the row, as in the script of the challenge.
  Eigen::Vector3d lift(const StirPoint& point) const {
    const PinholeCamera& left = calibration.left.pinhole;
    const double baseline_mm = -calibration.right_from_left.translation().x();
    const double z = left.fx_px * baseline_mm / std::max(point.disparity_px, 1e-6);
    return liftPixel(left, point.left_u_px, point.left_v_px, z);
  }
  Eigen::Vector2d project(const Eigen::Vector3d& point_mm) const {
    return projectPoint(calibration.left.pinhole,
                        Eigen::Vector3d(point_mm.x(), point_mm.y(), std::max(point_mm.z(), 1e-3)));
  }
};

ClipCameras camerasOf(const fs::path& clip) {
  SequenceReader reader(findSequence(clip), {});
  const auto first = reader.next();
  if (!first || !first->ok()) throw InputError(first ? first->error : shown(clip) + ": is empty");
  ClipCameras cameras;
  cameras.calibration = reader.calibration();
  cameras.raw_from_rectified =
      Rectifier(cameras.calibration).rig().rectified_from_raw_left.transpose();
  return cameras;
}

/// Tracks of the run, transformed into the frame of the raw left camera.
RunTracks tracksOf(const fs::path& run, const ClipCameras& cameras, std::size_t queries,
                   int frames) {
  RunTracks tracks = readRunTracks(run, queries, frames);
  for (auto& positions : tracks.positions_mm)
    for (Eigen::Vector3d& position : positions) position = cameras.raw_from_rectified * position;
  return tracks;
}

/// Fills missing positions: an unmeasured query moves with the nearest measured one, at its depth;
/// a frame without measurement repeats the previous one. Returns the number of filled positions.
std::size_t extrapolate(const std::vector<Eigen::Vector2d>& queries_px, const ClipCameras& cameras,
                        RunTracks* tracks) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < tracks->positions_mm.size(); ++f) {
    auto& positions = tracks->positions_mm[f];
    const std::vector<Eigen::Vector3d> measured = positions;
    for (std::size_t q = 0; q < positions.size(); ++q) {
      if (measured[q].allFinite()) continue;
      ++count;
      tracks->visible[f][q] = false;
      double nearest_px = std::numeric_limits<double>::infinity();
      for (std::size_t n = 0; n < positions.size(); ++n) {
        const double away_px = (queries_px[n] - queries_px[q]).norm();
        if (!measured[n].allFinite() || away_px >= nearest_px) continue;
        nearest_px = away_px;
        const double z = measured[n].z();
        const PinholeCamera& left = cameras.calibration.left.pinhole;
        positions[q] =
            measured[n] + Eigen::Vector3d((queries_px[q] - queries_px[n]).x() / left.fx_px * z,
                                          (queries_px[q] - queries_px[n]).y() / left.fy_px * z, 0);
      }
      if (!positions[q].allFinite() && f > 0) positions[q] = tracks->positions_mm[f - 1][q];
      if (!positions[q].allFinite()) throw InputError("no query was measured in the first frame");
    }
  }
  return count;
}

void judge(const StirAnnotations& truth, const ClipCameras& cameras, const RunTracks& tracks,
           StirClipResult* result) {
  const std::vector<StirPoint>& start = truth.begin()->second;
  for (const auto& [frame, points] : truth) {
    if (frame == 0) continue;  // reference frame
    const std::size_t f = std::min(static_cast<std::size_t>(frame), tracks.positions_mm.size() - 1);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const Eigen::Vector3d is_mm = cameras.lift(points[q]);
      const Eigen::Vector2d is_px(points[q].left_u_px, points[q].left_v_px);
      const Eigen::Vector2d began_px(start[q].left_u_px, start[q].left_v_px);
      const bool both = points[q].left_visible && points[q].right_visible;
      const Eigen::Vector3d& found_mm = tracks.positions_mm[f][q];
      const bool said = tracks.visible[f][q];
      result->points_mm.push_back({(found_mm - is_mm).norm(), both, said});
      result->control_mm.push_back({(cameras.lift(start[q]) - is_mm).norm(), both, true});
      result->points_px.push_back(
          {(cameras.project(found_mm) - is_px).norm(), points[q].left_visible, said});
      result->control_px.push_back({(began_px - is_px).norm(), points[q].left_visible, true});
    }
  }
}

std::string pointsCsv(const std::vector<Eigen::Vector2d>& queries) {
  std::string text = "id,u_px,v_px\n";
  for (std::size_t i = 0; i < queries.size(); ++i)
    text += say(i, ",", exactText(queries[i].x()), ",", exactText(queries[i].y()), "\n");
  return text;
}

StirAnnotations truthOf(const fs::path& clip) {
  StirAnnotations truth = readStirAnnotations(clip / "annotations.json");
  if (truth.begin()->first != 0)
    throw InputError(shown(clip) + ": annotations.json has no frame 0, where tracks begin.");
  return truth;
}

void addErrors(const StirAnnotations& truth, const ClipCameras& cameras, const RunTracks& tracks,
               StirClipResult* result) {
  for (const auto& [frame, points] : truth)
    for (std::size_t q = 0; q < points.size(); ++q) {
      const Eigen::Vector3d& found = tracks.positions_mm[static_cast<std::size_t>(frame)][q];
      if (found.allFinite()) result->error_mm.push_back((found - cameras.lift(points[q])).norm());
    }
}

/// Result folder of one clip, before and after its run.
class StirClip {
 public:
  StirClip(BenchmarkClip clip, const fs::path& out)
      : clip_(std::move(clip)), home_(out / "clips" / clip_.name) {
    result.name = clip_.name;
  }

  BenchmarkRun prepare(const BenchmarkOptions& options) const {
    const StirAnnotations truth = truthOf(clip_.folder);
    const std::vector<Eigen::Vector2d> queries = readStirQueries(clip_.folder / "queries.json");
    if (queries.size() != truth.begin()->second.size())
      throw InputError(say(shown(clip_.folder), ": queries.json has ", queries.size(),
                           " points, but annotations.json ", truth.begin()->second.size(), "."));
    fs::create_directories(home_);
    writeFile(home_ / "points.csv", pointsCsv(queries), true);
    return reconstruction(clip_.folder, home_ / "run", {"--track", (home_ / "points.csv").string()},
                          options);
  }

  void score(std::map<int, StirPrediction>* predictions) {
    const StirAnnotations truth = truthOf(clip_.folder);
    const std::vector<Eigen::Vector2d> queries = readStirQueries(clip_.folder / "queries.json");
    const ClipCameras cameras = camerasOf(clip_.folder);
    RunTracks tracks = tracksOf(home_ / "run", cameras, queries.size(), truth.rbegin()->first + 1);
    addErrors(truth, cameras, tracks, &result);
    result.extrapolated = extrapolate(queries, cameras, &tracks);
    judge(truth, cameras, tracks, &result);
    const std::vector<double> latency_ms = readLatencies(home_ / "run");
    for (std::size_t f = kStirWarmUpFrames + 1; f < latency_ms.size(); ++f)
      result.latency_ms.push_back(latency_ms[f]);
    for (std::size_t f = 0; f < tracks.positions_mm.size(); ++f)
      (*predictions)[static_cast<int>(f)] = {tracks.positions_mm[f], tracks.visible[f],
                                             f < latency_ms.size() ? latency_ms[f] : 0};
  }

  StirClipResult result;

 private:
  BenchmarkClip clip_;
  fs::path home_;
};

}  // namespace

StirBenchmarkResult benchmarkStir(const BenchmarkOptions& options,
                                  const RunSoftscope& run_softscope, const Progress& progress) {
  std::vector<StirClip> clips;
  for (const BenchmarkClip& clip :
       findClips(options.data, isStirClip,
                 "STIR 2026; a folder with calib.json, annotations.json, queries.json and videos, "
                 "or a folder of such folders, is expected."))
    clips.emplace_back(clip, options.out);
  std::vector<BenchmarkRun> runs(clips.size());
  for (std::size_t i = 0; i < clips.size(); ++i) {
    runs[i].done = true;  // set to false below if there is work
    excludeOnError(&clips[i].result.excluded, [&] { runs[i] = clips[i].prepare(options); });
  }
  StirBenchmarkResult result;
  result.stopped = !runAll(&runs, options.jobs, run_softscope, progress);
  if (result.stopped) return result;
  std::map<std::string, std::map<int, StirPrediction>> predictions;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    if (clips[i].result.excluded.empty()) clips[i].result.excluded = runs[i].failure;
    if (clips[i].result.excluded.empty())
      excludeOnError(&clips[i].result.excluded,
                     [&] { clips[i].score(&predictions[clips[i].result.name]); });
    if (!clips[i].result.excluded.empty()) predictions.erase(clips[i].result.name);
    result.clips.push_back(clips[i].result);
  }
  requireOneJudged(result.clips, options.data);
  writeFile(options.out / "preds.json", stirPredictionsJson(predictions), true);
  writeFile(options.out / "benchmark.json", jsonText(stirBenchmarkFacts(result).json()), true);
  return result;
}

}  // namespace softscope
