#include "toolkit/benchmark/stir_benchmark.h"

#include <algorithm>
#include <cmath>
#include <fstream>
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
#include "toolkit/run/run_reader.h"
#include "toolkit/run/table_reader.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool isStirClip(const fs::path& folder) {
  return isFile(folder / "calib.json") && isFile(folder / "annotations.json");
}

/// What a clip says of its cameras; truth is in the frame of the raw left one.
struct ClipCameras {
  StereoCalibration calibration;
  Eigen::Matrix3d raw_from_rectified = Eigen::Matrix3d::Identity();

  /// As the challenge's script: pinhole, disparity along the row.
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

/// Positions in the raw left camera's frame, by frame and query; NaN where the run has none.
struct RunTracks {
  std::vector<std::vector<Eigen::Vector3d>> positions_mm;
  std::vector<std::vector<bool>> visible;
};

RunTracks tracksOf(const fs::path& run_folder, const ClipCameras& cameras, std::size_t queries,
                   int frames) {
  const JudgedRun run = openJudgedRun(run_folder);
  const Eigen::Vector3d nowhere =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  RunTracks tracks;
  tracks.positions_mm.assign(static_cast<std::size_t>(frames),
                             std::vector<Eigen::Vector3d>(queries, nowhere));
  tracks.visible.assign(static_cast<std::size_t>(frames), std::vector<bool>(queries, false));
  std::map<int, Eigen::Isometry3d> left_from_world;
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    left_from_world[run.frames[i]] = run.trajectory[i].world_from_left.inverse();
  for (const TrackSample& sample : readTracks(run.tracks)) {
    const auto pose = left_from_world.find(sample.frame);
    if (pose == left_from_world.end() || sample.frame >= frames || sample.id < 0 ||
        sample.id >= static_cast<int>(queries) || !sample.position_mm.allFinite())
      continue;
    const auto f = static_cast<std::size_t>(sample.frame), q = static_cast<std::size_t>(sample.id);
    tracks.positions_mm[f][q] = cameras.raw_from_rectified * (pose->second * sample.position_mm);
    tracks.visible[f][q] = sample.visible;
  }
  return tracks;
}

/// Gives every query a position in every frame: a query that is not measured moves as the nearest
/// measured one, at its depth; a frame without any repeats the one before. Returns how many.
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
      if (!positions[q].allFinite())
        throw InputError("not one query was measured in the first frame");
    }
  }
  return count;
}

void judge(const StirAnnotations& truth, const ClipCameras& cameras, const RunTracks& tracks,
           StirClipResult* result) {
  const std::vector<StirPoint>& start = truth.begin()->second;
  for (const auto& [frame, points] : truth) {
    if (frame == 0) continue;  // the reference
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

std::vector<double> latenciesOf(const fs::path& run) {
  const fs::path file = run / "frames.csv";
  std::ifstream stream(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  const NumberTable table(text, shown(file), {"frame", "total_ms"}, {});
  std::vector<double> all;
  for (std::size_t row = 0; row < table.rows(); ++row) all.push_back(table.at(row, 1));
  return all;
}

std::string pointsCsv(const std::vector<Eigen::Vector2d>& queries) {
  std::string text = "id,u_px,v_px\n";
  for (std::size_t i = 0; i < queries.size(); ++i)
    text += say(i, ",", exactText(queries[i].x()), ",", exactText(queries[i].y()), "\n");
  return text;
}

std::string lastLineOf(const fs::path& log) {
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) last = line;
  return last;
}

bool isComplete(const fs::path& run) {
  return isFile(run / "run.json") && !isFile(run / "checkpoint.bin") && isFile(run / "tracks.csv");
}

class StirRunner {
 public:
  explicit StirRunner(const StirBenchmarkOptions& options) : options_(options) {}

  template <class RunSoftscope>
  StirClipResult run(const fs::path& clip, const RunSoftscope& run_softscope) {
    StirClipResult result;
    result.name = clip.filename().string();
    try {
      runClip(clip, run_softscope, &result);
    } catch (const InputError& problem) {
      result.excluded = problem.what();
    }
    return result;
  }

  std::string predictions() const { return stirPredictionsJson(predictions_); }

 private:
  template <class RunSoftscope>
  void runClip(const fs::path& clip, const RunSoftscope& run_softscope, StirClipResult* result) {
    const StirAnnotations truth = readStirAnnotations(clip / "annotations.json");
    if (truth.begin()->first != 0)
      throw InputError(shown(clip) + ": annotations.json has no frame 0, where tracks begin.");
    const std::vector<Eigen::Vector2d> queries = readStirQueries(clip / "queries.json");
    if (queries.size() != truth.begin()->second.size())
      throw InputError(say(shown(clip), ": queries.json has ", queries.size(),
                           " points, but annotations.json ", truth.begin()->second.size(), "."));
    const fs::path home = options_.out / "clips" / result->name, run = home / "run";
    fs::create_directories(home);
    writeFile(home / "points.csv", pointsCsv(queries), true);
    if (options_.force || !isComplete(run)) reconstruct(clip, home, run_softscope);
    const ClipCameras cameras = camerasOf(clip);
    RunTracks tracks = tracksOf(run, cameras, queries.size(), truth.rbegin()->first + 1);
    addErrors(truth, cameras, tracks, result);
    result->extrapolated = extrapolate(queries, cameras, &tracks);
    judge(truth, cameras, tracks, result);
    const std::vector<double> latency_ms = latenciesOf(run);
    for (std::size_t f = kStirWarmUpFrames + 1; f < latency_ms.size(); ++f)
      result->latency_ms.push_back(latency_ms[f]);
    for (std::size_t f = 0; f < tracks.positions_mm.size(); ++f)
      predictions_[result->name][static_cast<int>(f)] = {tracks.positions_mm[f], tracks.visible[f],
                                                         f < latency_ms.size() ? latency_ms[f] : 0};
  }

  static void addErrors(const StirAnnotations& truth, const ClipCameras& cameras,
                        const RunTracks& tracks, StirClipResult* result) {
    for (const auto& [frame, points] : truth)
      for (std::size_t q = 0; q < points.size(); ++q) {
        const Eigen::Vector3d& found = tracks.positions_mm[static_cast<std::size_t>(frame)][q];
        if (found.allFinite()) result->error_mm.push_back((found - cameras.lift(points[q])).norm());
      }
  }

  template <class RunSoftscope>
  void reconstruct(const fs::path& clip, const fs::path& home, const RunSoftscope& run_softscope) {
    const fs::path run = home / "run";
    std::vector<std::string> words{
        "reconstruct", clip.string(), "--track", (home / "points.csv").string(),
        "--out",       run.string(),  "--quiet"};
    if (isFolder(run)) words.emplace_back("--force");
    for (const std::string& setting : options_.settings) {
      words.emplace_back("--set");
      words.push_back(setting);
    }
    const fs::path log = home / "log.txt";
    const int code = run_softscope(words, log);
    if (code != 0)
      throw InputError(say("reconstruct ended with exit code ", code, ": ", lastLineOf(log)));
  }

  const StirBenchmarkOptions& options_;
  std::map<std::string, std::map<int, StirPrediction>> predictions_;
};

}  // namespace

std::vector<fs::path> findStirClips(const fs::path& data) {
  requireFolder(data);
  if (isStirClip(data)) return {data.has_filename() ? data : data.parent_path()};
  std::vector<fs::path> clips;
  for (const auto& entry : fs::directory_iterator(data))
    if (isFolder(entry.path()) && isStirClip(entry.path())) clips.push_back(entry.path());
  if (clips.empty())
    throw InputError(shown(data) +
                     ": holds no clip of STIR 2026; a folder with calib.json, "
                     "annotations.json, queries.json and videos, or a folder of such "
                     "folders, is expected.");
  std::sort(clips.begin(), clips.end(), [](const fs::path& a, const fs::path& b) {
    return naturallyBefore(a.filename().string(), b.filename().string());
  });
  return clips;
}

StirBenchmarkResult benchmarkStir(
    const StirBenchmarkOptions& options,
    const std::function<int(const std::vector<std::string>&, const fs::path&)>& run_softscope,
    const Progress& progress) {
  const std::vector<fs::path> clips = findStirClips(options.data);
  const int total = static_cast<int>(clips.size());
  StirBenchmarkResult result;
  StirRunner runner(options);
  for (int i = 0; i < total; ++i) {
    if (!goesOn(progress, i, total)) {
      result.stopped = true;
      return result;
    }
    result.clips.push_back(runner.run(clips[static_cast<std::size_t>(i)], run_softscope));
  }
  if (!goesOn(progress, total, total)) {
    result.stopped = true;
    return result;
  }
  if (std::all_of(result.clips.begin(), result.clips.end(),
                  [](const StirClipResult& clip) { return !clip.excluded.empty(); }))
    throw InputError(say(shown(options.data), ": not one of ", total,
                         " clips could be judged; the first: ", result.clips[0].excluded));
  writeFile(options.out / "preds.json", runner.predictions(), true);
  writeFile(options.out / "benchmark.json", jsonText(stirBenchmarkFacts(result).json()), true);
  return result;
}

}  // namespace softscope
