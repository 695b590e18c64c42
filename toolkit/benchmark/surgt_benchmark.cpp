#include "toolkit/benchmark/surgt_benchmark.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "eval/statistics/statistics.h"
#include "io/datasets/surgt_files.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "stereo/rectification/rectifier.h"
#include "stereo/rectification/valid_rectification.h"
#include "toolkit/record/json_text.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr int kStartEvery = 50;     // frames; as in the configuration of the challenge
constexpr int kPixelsPerSide = 5;   // tracked pixels per box: a centred grid
constexpr double kGridShare = 0.7;  // extent of the grid, as a share of the sides of the box
constexpr std::size_t kPixelsPerBox = std::size_t{kPixelsPerSide} * kPixelsPerSide;

bool isSurgtCase(const fs::path& folder) {
  return isFile(folder / "info.yaml") && isFile(folder / "calibration.yaml");
}

StereoBoxes boxesOf(const std::array<std::array<double, 4>, 2>& boxes) {
  const auto box = [](const std::array<double, 4>& b) { return PixelBox{b[0], b[1], b[2], b[3]}; };
  return {box(boxes[0]), box(boxes[1])};
}

std::vector<BoxTruth> truthOfTarget(const fs::path& file) {
  std::vector<BoxTruth> truth;
  for (const SurgtFrame& frame : readSurgtTruth(file)) {
    truth.push_back({frame.visible_in_both, frame.difficult, std::nullopt});
    if (frame.boxes) truth.back().boxes = boxesOf(*frame.boxes);
  }
  return truth;
}

bool isInside(const PixelBox& box, const PinholeCamera& camera) {
  return box.u_px >= 0 && box.v_px >= 0 && box.u_px + box.width_px < camera.width_px &&
         box.v_px + box.height_px < camera.height_px;
}

/// For every 50th frame the first frame from there on with usable true boxes; -1: none.
std::vector<int> startsOf(const std::vector<BoxTruth>& truth, const PinholeCamera& camera) {
  std::vector<int> starts;
  const int frames = static_cast<int>(truth.size());
  for (int anchor = 0; anchor < frames; anchor += kStartEvery) {
    int start = anchor;
    const auto usable = [&](const BoxTruth& t) {
      return t.visible && !t.difficult && t.boxes && isInside(t.boxes->left, camera) &&
             isInside(t.boxes->right, camera);
    };
    while (start < frames && !usable(truth[static_cast<std::size_t>(start)])) ++start;
    if (start + 1 < frames) starts.push_back(start);
  }
  return starts;
}

/// Tracker of one target from a start frame; its pixels are points
/// [first_point, + kPixelsPerBox) of the run that begins there.
struct StartedTarget {
  std::size_t target = 0;
  std::size_t first_point = 0;
};

/// One video with its truth, start frames and runs.
class SurgtCase {
 public:
  SurgtCase(BenchmarkClip clip, const fs::path& out)
      : clip_(std::move(clip)), home_(out / "clips" / clip_.name) {
    result.name = clip_.name;
  }

  void open() {
    SequenceReader reader(findSequence(clip_.folder), {});
    calibration_ = reader.calibration();
    frames_ = reader.totalCount();
    const SurgtInfo info = readSurgtInfo(clip_.folder / "info.yaml");
    if (info.truth.empty())
      throw InputError(shown(clip_.folder) +
                       ": info.yaml names no ground truth; boxes to start with are expected.");
    const ValidRectification valid(calibration_);
    for (const std::string& name : info.truth) {
      truths_.push_back(truthOfTarget(clip_.folder / name));
      if (static_cast<int>(truths_.back().size()) < frames_)
        throw InputError(say(shown(clip_.folder / name), ": has ", truths_.back().size(),
                             " frames, but the video has ", frames_, "; one a frame is expected."));
      truths_.back().resize(static_cast<std::size_t>(frames_));
      for (const int start : startsOf(truths_.back(), valid.rig().left))
        starts_[start].push_back({truths_.size() - 1, kPixelsPerBox * starts_[start].size()});
    }
    if (starts_.empty())
      throw InputError(shown(clip_.folder) + ": has no frame with a true box to start with.");
  }

  std::vector<BenchmarkRun> prepare(const BenchmarkOptions& options) const {
    const ValidRectification valid(calibration_);
    std::vector<BenchmarkRun> runs;
    for (const auto& [start, targets] : starts_) {
      const fs::path folder = homeOf(start);
      fs::create_directories(folder);
      std::string csv = "id,u_px,v_px\n";
      std::size_t id = 0;
      for (const StartedTarget& target : targets)
        for (const Eigen::Vector2d& pixel : gridOf(boxAt(target.target, start).left)) {
          const Eigen::Vector2d raw = valid.rawLeftPixel(pixel);
          csv += say(id++, ",", exactText(raw.x()), ",", exactText(raw.y()), "\n");
        }
      writeFile(folder / "points.csv", csv, true);
      runs.push_back(reconstruction(
          clip_.folder, folder / "run",
          {"--frames", std::to_string(start) + ":", "--track", (folder / "points.csv").string()},
          options));
    }
    return runs;
  }

  /// `failures`: one entry per run of prepare(), in their order.
  void score(const std::vector<std::string>& failures) {
    const ValidRectification valid(calibration_);
    std::vector<std::vector<JudgedBoxTrack>> found(truths_.size()), still(truths_.size());
    std::size_t run = 0;
    for (const auto& [start, targets] : starts_) {
      const std::vector<BoxTrack> tracks =
          failures[run++].empty() ? tracksOf(start, targets, valid) : std::vector<BoxTrack>();
      for (std::size_t i = 0; i < targets.size(); ++i) {
        const std::size_t target = targets[i].target;
        const BoxTrack track = tracks.empty() ? BoxTrack{start, {}} : tracks[i];
        result.missing_starts += tracks.empty();
        ++result.starts;
        countEstimates(truths_[target], track);
        found[target].push_back(judgeBoxTrack(truths_[target], track, valid.rig()));
        still[target].push_back(
            judgeBoxTrack(truths_[target], standingStill(target, start), valid.rig()));
      }
    }
    if (result.missing_starts == result.starts)
      throw InputError("no run succeeded: " + failures[0]);
    result.found = merged(found);
    result.control = merged(still);
  }

  SurgtClipResult result;

 private:
  fs::path homeOf(int start) const { return home_ / numberedName(start, ""); }
  const StereoBoxes& boxAt(std::size_t target, int frame) const {
    return *truths_[target][static_cast<std::size_t>(frame)].boxes;
  }

  static std::vector<Eigen::Vector2d> gridOf(const PixelBox& box) {
    std::vector<Eigen::Vector2d> pixels;
    for (int row = 0; row < kPixelsPerSide; ++row)
      for (int column = 0; column < kPixelsPerSide; ++column) {
        const auto at = [](int i) {
          return 0.5 + kGridShare * (static_cast<double>(i) / (kPixelsPerSide - 1) - 0.5);
        };
        pixels.emplace_back(box.u_px + at(column) * box.width_px,
                            box.v_px + at(row) * box.height_px);
      }
    return pixels;
  }

  BoxTrack standingStill(std::size_t target, int start) const {
    return {start, std::vector<std::optional<StereoBoxes>>(
                       static_cast<std::size_t>(frames_ - start - 1), boxAt(target, start))};
  }

  void countEstimates(const std::vector<BoxTruth>& truth, const BoxTrack& track) {
    for (std::size_t f = static_cast<std::size_t>(track.first_frame) + 1; f < truth.size(); ++f) {
      if (!truth[f].visible || truth[f].difficult) continue;
      ++result.frames;
      const std::size_t i = f - static_cast<std::size_t>(track.first_frame) - 1;
      result.boxes += i < track.boxes.size() && track.boxes[i].has_value();
    }
  }

  std::vector<BoxTrack> tracksOf(int start, const std::vector<StartedTarget>& targets,
                                 const ValidRectification& valid) {
    const fs::path run = homeOf(start) / "run";
    RunTracks points = readRunTracks(run, kPixelsPerBox * targets.size(), frames_);
    const Eigen::Matrix3d turn = valid.rig().rectified_from_raw_left *
                                 Rectifier(calibration_).rig().rectified_from_raw_left.transpose();
    for (auto& positions : points.positions_mm)
      for (Eigen::Vector3d& position : positions) position = turn * position;
    const std::vector<double> latency_ms = readLatencies(run);
    if (!latency_ms.empty())
      result.latency_ms.insert(result.latency_ms.end(), latency_ms.begin() + 1, latency_ms.end());
    std::vector<BoxTrack> tracks;
    for (const StartedTarget& target : targets)
      tracks.push_back(trackOf(target, start, points, valid.rig()));
    return tracks;
  }

  /// The box moves with the median of its points and scales with the
  /// inverse of their depth. A frame without a pose repeats the previous
  /// box; a target with less than half of its points visible has no box.
  BoxTrack trackOf(const StartedTarget& target, int start, const RunTracks& points,
                   const RectifiedRig& rig) const {
    const StereoBoxes& first = boxAt(target.target, start);
    const auto& begin = points.positions_mm[static_cast<std::size_t>(start)];
    BoxTrack track{start, {}};
    std::optional<StereoBoxes> last = first;
    for (int f = start + 1; f < frames_; ++f) {
      const auto& now = points.positions_mm[static_cast<std::size_t>(f)];
      std::vector<double> du, dv, du_right, depth_ratio;
      int visible = 0;
      for (std::size_t i = target.first_point; i < target.first_point + kPixelsPerBox; ++i) {
        if (!begin[i].allFinite() || !now[i].allFinite() || !(now[i].z() > 0)) continue;
        visible += points.visible[static_cast<std::size_t>(f)][i];
        const Eigen::Vector2d moved =
            projectPoint(rig.left, now[i]) - projectPoint(rig.left, begin[i]);
        du.push_back(moved.x());
        dv.push_back(moved.y());
        du_right.push_back(moved.x() - rig.disparityPx(now[i].z()) + rig.disparityPx(begin[i].z()));
        depth_ratio.push_back(begin[i].z() / now[i].z());
      }
      if (!du.empty()) {
        last.reset();
        if (2 * visible >= static_cast<int>(du.size())) {
          const double scale = statistics(depth_ratio).median;
          const double v = statistics(dv).median;
          last = StereoBoxes{movedBox(first.left, statistics(du).median, v, scale),
                             movedBox(first.right, statistics(du_right).median, v, scale)};
        }
      }
      track.boxes.push_back(last);
    }
    return track;
  }

  static PixelBox movedBox(const PixelBox& box, double du_px, double dv_px, double scale) {
    const double width_px = box.width_px * scale, height_px = box.height_px * scale;
    return {box.u_px + box.width_px / 2 + du_px - width_px / 2,
            box.v_px + box.height_px / 2 + dv_px - height_px / 2, width_px, height_px};
  }

  static SurgtVideoScores merged(const std::vector<std::vector<JudgedBoxTrack>>& targets) {
    SurgtVideoScores scores;
    for (const auto& tracks : targets) {
      std::vector<BoxScores> each;
      std::vector<std::vector<double>> overlaps;
      for (const JudgedBoxTrack& track : tracks) {
        each.push_back(track.scores);
        overlaps.push_back(track.overlaps);
      }
      if (each.empty()) continue;  // target without a usable box
      scores.targets.push_back(mergeBoxScores(each));
      scores.overlaps.push_back(overlapCurve(overlaps));
    }
    return scores;
  }

  BenchmarkClip clip_;
  fs::path home_;
  StereoCalibration calibration_;
  int frames_ = 0;
  std::vector<std::vector<BoxTruth>> truths_;
  std::map<int, std::vector<StartedTarget>> starts_;  // by frame
};

}  // namespace

SurgtBenchmarkResult benchmarkSurgt(const BenchmarkOptions& options,
                                    const RunSoftscope& run_softscope, const Progress& progress) {
  std::vector<SurgtCase> cases;
  for (const BenchmarkClip& clip :
       findClips(options.data, isSurgtCase,
                 "SurgT; a folder with info.yaml, calibration.yaml, a video and true boxes, or a "
                 "folder of such folders, is expected."))
    cases.emplace_back(clip, options.out);
  std::vector<BenchmarkRun> runs;
  std::vector<std::size_t> first_run;
  for (SurgtCase& one : cases) {
    first_run.push_back(runs.size());
    excludeOnError(&one.result.excluded, [&] {
      one.open();
      const std::vector<BenchmarkRun> own = one.prepare(options);
      runs.insert(runs.end(), own.begin(), own.end());
    });
  }
  first_run.push_back(runs.size());
  SurgtBenchmarkResult result;
  result.stopped = !runAll(&runs, options.jobs, run_softscope, progress);
  if (result.stopped) return result;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    std::vector<std::string> failures;
    for (std::size_t r = first_run[i]; r < first_run[i + 1]; ++r)
      failures.push_back(runs[r].failure);
    if (cases[i].result.excluded.empty())
      excludeOnError(&cases[i].result.excluded, [&] { cases[i].score(failures); });
    result.clips.push_back(cases[i].result);
  }
  requireOneJudged(result.clips, options.data);
  writeFile(options.out / "benchmark.json", jsonText(surgtBenchmarkFacts(result).json()), true);
  return result;
}

}  // namespace softscope
