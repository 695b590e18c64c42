#include "toolkit/benchmark/end_point_benchmark.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/motion/tracking_scores.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/images/image_reader.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool isStirSequence(const fs::path& folder) {
  return isFolder(folder / "frames") && isFile(folder / "segmentation" / "icgstartseg.png");
}

std::vector<Eigen::Vector2d> marksIn(const fs::path& file) {
  const std::vector<Eigen::Vector2d> centres = markCentres(readMask(file));
  if (centres.empty())
    throw InputError(shown(file) +
                     ": has no mark, but tattoos are expected. Is it the "
                     "segmentation?");
  return centres;
}

Eigen::Vector3d inImage(const Eigen::Vector2d& pixel) { return {pixel.x(), pixel.y(), 0}; }

class EndPointClip {
 public:
  EndPointClip(BenchmarkClip clip, const fs::path& out)
      : clip_(std::move(clip)), home_(out / "clips" / clip_.name) {
    result.name = clip_.name;
  }

  BenchmarkRun prepare(const BenchmarkOptions& options) {
    starts_ = marksIn(clip_.folder / "segmentation" / "icgstartseg.png");
    ends_ = marksIn(clip_.folder / "segmentation" / "icgendseg.png");
    fs::create_directories(home_);
    std::string csv = "id,u_px,v_px\n";
    for (std::size_t i = 0; i < starts_.size(); ++i)
      csv += say(i, ",", exactText(starts_[i].x()), ",", exactText(starts_[i].y()), "\n");
    writeFile(home_ / "points.csv", csv, true);
    return reconstruction(clip_.folder, home_ / "run", {"--track", (home_ / "points.csv").string()},
                          options);
  }

  void score() {
    SequenceReader reader(findSequence(clip_.folder), {});
    const StereoCalibration calibration = reader.calibration();
    const Eigen::Matrix3d raw_from_rectified =
        Rectifier(calibration).rig().rectified_from_raw_left.transpose();
    const RunTracks tracks = readRunTracks(home_ / "run", starts_.size(), reader.totalCount());
    std::vector<Eigen::Vector3d> found, still, truth;
    for (const Eigen::Vector2d& end : ends_) truth.push_back(inImage(end));
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      still.push_back(inImage(starts_[i]));
      found.push_back(still.back());
      const Eigen::Vector3d last = raw_from_rectified * tracks.positions_mm.back()[i];
      if (!last.allFinite() || !(last.z() > 0)) continue;
      found.back() = inImage(projectPoint(calibration.left.pinhole, last));
      ++result.measured;
    }
    result.points = static_cast<int>(starts_.size());
    result.found_px = endPointDistances(found, truth);
    result.control_px = endPointDistances(still, truth);
    const std::vector<double> latency_ms = readLatencies(home_ / "run");
    if (!latency_ms.empty()) result.latency_ms.assign(latency_ms.begin() + 1, latency_ms.end());
  }

  EndPointClipResult result;

 private:
  BenchmarkClip clip_;
  fs::path home_;
  std::vector<Eigen::Vector2d> starts_, ends_;
};

void addEndPoints(const std::string& label, const std::string& key,
                  const std::vector<double>& distances_px, FactSheet* facts) {
  const EndPointScores scores = endPointScores(distances_px, endPointThresholdsPx());
  facts->addLine(label, "delta_avg " + fixed(scores.average_accuracy, 4) + "  mean " +
                            fixed(scores.distance.mean, 2) + "  median " +
                            fixed(scores.distance.median, 2) + " px");
  facts->addQuietly(key, {{"delta_avg", orNull(scores.average_accuracy)},
                          {"accuracy_at", scores.accuracy_at},
                          {"mean_px", orNull(scores.distance.mean)},
                          {"median_px", orNull(scores.distance.median)},
                          {"points", scores.distance.count}});
}

double deltaOf(const std::vector<double>& distances_px) {
  return endPointScores(distances_px, endPointThresholdsPx()).average_accuracy;
}

}  // namespace

std::vector<Eigen::Vector2d> markCentres(const Mask& marks) {
  Mask left = marks;
  std::vector<Eigen::Vector2d> centres;
  for (int v = 0; v < left.height_px; ++v)
    for (int u = 0; u < left.width_px; ++u) {
      if (left.at(u, v) == 0) continue;
      int u_min = u, u_max = u, v_max = v;
      std::vector<Eigen::Vector2i> front{{u, v}};
      left.at(u, v) = 0;
      while (!front.empty()) {
        const Eigen::Vector2i at = front.back();
        front.pop_back();
        u_min = std::min(u_min, at.x());
        u_max = std::max(u_max, at.x());
        v_max = std::max(v_max, at.y());
        for (int dv = -1; dv <= 1; ++dv)
          for (int du = -1; du <= 1; ++du) {
            const Eigen::Vector2i next(at.x() + du, at.y() + dv);
            if (!left.contains(next.x(), next.y()) || left.at(next.x(), next.y()) == 0) continue;
            left.at(next.x(), next.y()) = 0;
            front.push_back(next);
          }
      }
      centres.emplace_back((u_min + u_max) / 2.0, (v + v_max) / 2.0);
    }
  return centres;
}

EndPointBenchmarkResult benchmarkStirEnds(const BenchmarkOptions& options,
                                          const RunSoftscope& run_softscope,
                                          const Progress& progress) {
  std::vector<EndPointClip> clips;
  for (const BenchmarkClip& clip :
       findClips(options.data, isStirSequence,
                 "STIR; PATIENT/left.../seqNN with frames and segmentation/icgstartseg.png, or a "
                 "folder of patients, is expected."))
    clips.emplace_back(clip, options.out);
  std::vector<BenchmarkRun> runs(clips.size());
  for (std::size_t i = 0; i < clips.size(); ++i) {
    runs[i].done = true;  // set to false below if there is work
    excludeOnError(&clips[i].result.excluded, [&] { runs[i] = clips[i].prepare(options); });
  }
  EndPointBenchmarkResult result;
  result.stopped = !runAll(&runs, options.jobs, run_softscope, progress);
  if (result.stopped) return result;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    std::string& excluded = clips[i].result.excluded;
    if (excluded.empty()) excluded = runs[i].failure;
    if (excluded.empty()) excludeOnError(&excluded, [&] { clips[i].score(); });
    result.clips.push_back(clips[i].result);
  }
  requireOneJudged(result.clips, options.data);
  writeFile(options.out / "benchmark.json", jsonText(endPointFacts(result).json()), true);
  return result;
}

FactSheet endPointFacts(const EndPointBenchmarkResult& result) {
  std::vector<std::string> judged;
  std::vector<ExcludedClip> excluded;
  std::vector<double> found_px, control_px, latency_ms, delta, gain;
  int points = 0, measured = 0;
  for (const EndPointClipResult& clip : result.clips) {
    if (!clip.excluded.empty()) {
      excluded.push_back({clip.name, clip.excluded});
      continue;
    }
    judged.push_back(clip.name);
    found_px.insert(found_px.end(), clip.found_px.begin(), clip.found_px.end());
    control_px.insert(control_px.end(), clip.control_px.begin(), clip.control_px.end());
    latency_ms.insert(latency_ms.end(), clip.latency_ms.begin(), clip.latency_ms.end());
    delta.push_back(deltaOf(clip.found_px));
    gain.push_back(delta.back() - deltaOf(clip.control_px));
    points += clip.points;
    measured += clip.measured;
  }
  FactSheet facts("STIR (to 2025)");
  addClips(judged, excluded, &facts);
  facts.add("protocol", "protocol",
            std::string("centres of the bounding boxes of the tattoos, all sequences in one pool; "
                        "distance of the last position from the nearest true end point in the left "
                        "image, <= 4, 8, 16, 32, 64 px; no 3-D score"));
  addEndPoints("2-D", "scores_2d", found_px, &facts);
  addEndPoints("2-D, nothing moves", "control_2d", control_px, &facts);
  const double coverage = points == 0 ? std::nan("") : static_cast<double>(measured) / points;
  facts.add("coverage",
            fixed(100 * coverage, 1) +
                " % of the points have an end point; the others keep their first position",
            "coverage", orNull(coverage));
  addClusterMean("delta_avg per sequence", "clip_delta_avg_2d", "", "sequences", delta, &facts);
  addClusterMean("over the control", "clip_delta_avg_2d_over_control", "", "sequences", gain,
                 &facts);
  if (judged.size() < 3)
    facts.addLine("intervals", "none: a bootstrap over sequences needs three or more");
  addLatency(latency_ms, "per frame, without the first of each run", &facts);
  return facts;
}

}  // namespace softscope
