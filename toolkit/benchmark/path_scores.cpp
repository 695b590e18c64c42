#include "toolkit/benchmark/path_scores.h"

#include <cmath>

#include "core/error.h"
#include "io/text/message.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

constexpr std::size_t kLeastPoses = 2;

struct PathRow {
  std::vector<double> ate_mm, rpe_mm, rpe_deg, ate_scaled_mm;

  void add(const TrajectoryErrors& errors) {
    ate_mm.push_back(errors.absolute.translation_mm.rmse);
    rpe_mm.push_back(errors.relative.translation_mm.rmse);
    rpe_deg.push_back(errors.relative.rotation_deg.rmse);
    ate_scaled_mm.push_back(errors.absolute_scaled.translation_mm.rmse);
  }
};

void addPathRow(const std::string& label, const std::string& key, const PathRow& row,
                FactSheet* facts) {
  const double ate = statistics(row.ate_mm).mean, rpe = statistics(row.rpe_mm).mean,
               turn = statistics(row.rpe_deg).mean, scaled = statistics(row.ate_scaled_mm).mean;
  facts->addLine(label, "ATE-RMSE " + fixed(ate, 3) + " mm (SE(3))  RPE " + fixed(rpe, 3) +
                            " mm, " + fixed(turn, 3) + "° a frame" +
                            (std::isfinite(scaled)
                                 ? "  ATE-RMSE " + fixed(scaled, 3) + " mm (Sim(3), not comparable)"
                                 : ""));
  facts->addQuietly(key, {{"ate_rmse_mm", orNull(ate)},
                          {"rpe_rmse_mm", orNull(rpe)},
                          {"rpe_rmse_deg", orNull(turn)},
                          {"ate_sim3_rmse_mm", orNull(scaled)}});
}

}  // namespace

void judgePath(const JudgedRun& run, const std::map<int, Eigen::Isometry3d>& world_from_raw_left,
               const Eigen::Isometry3d& rectified_from_raw, PathClipResult* result) {
  std::vector<Eigen::Isometry3d> expected, found;
  std::vector<int> moments;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const auto pose = world_from_raw_left.find(run.frames[i]);
    if (pose == world_from_raw_left.end()) continue;
    ++result->frames;
    if (!run.isPlaced(run.frames[i])) {
      ++result->lost;
      continue;
    }
    expected.push_back(pose->second);
    found.push_back(run.trajectory[i].world_from_left * rectified_from_raw);
    moments.push_back(run.frames[i]);
  }
  if (expected.size() < kLeastPoses)
    throw InputError(say("there are true poses of ", result->frames, " of the ", run.frames.size(),
                         " frames of the run, ", result->lost,
                         " of them lost; two or more are needed"));
  result->found = trajectoryErrors(expected, found, moments);
  result->control = trajectoryErrors(
      expected, std::vector<Eigen::Isometry3d>(expected.size(), Eigen::Isometry3d::Identity()),
      moments);
}

FactSheet pathBenchmarkFacts(const PathBenchmarkResult& result) {
  PathRow found, control;
  std::vector<std::string> judged;
  std::vector<ExcludedClip> excluded;
  std::vector<double> latency_ms;
  std::map<std::string, std::vector<double>> by_sequence;
  int frames = 0, lost = 0;
  FactSheet::Json ranges = FactSheet::Json::array();
  for (const PathClipResult& clip : result.clips) {
    if (!clip.excluded.empty()) {
      excluded.push_back({clip.name, clip.excluded});
      continue;
    }
    judged.push_back(clip.name);
    found.add(clip.found);
    control.add(clip.control);
    by_sequence[clip.sequence].push_back(found.ate_mm.back());
    latency_ms.insert(latency_ms.end(), clip.latency_ms.begin(), clip.latency_ms.end());
    frames += clip.frames;
    lost += clip.lost;
    ranges.push_back({{"clip", clip.name},
                      {"ate_rmse_mm", orNull(found.ate_mm.back())},
                      {"rpe_rmse_mm", orNull(found.rpe_mm.back())},
                      {"control_ate_rmse_mm", orNull(control.ate_mm.back())},
                      {"frames", clip.frames},
                      {"lost", clip.lost}});
  }
  FactSheet facts(result.title);
  addClips(judged, excluded, &facts);
  facts.add(
      "protocol", "protocol",
      result.protocol +
          "; ATE after rigid alignment of all positions, SE(3), no scale; RPE from frame to frame; "
          "means over ranges; frames reported as lost are excluded and counted");
  addPathRow("path", "path", found, &facts);
  addPathRow("nothing moves", "control", control, &facts);
  const double coverage = frames == 0 ? Statistics::kNone : 1 - static_cast<double>(lost) / frames;
  facts.add("coverage", fixed(100 * coverage, 1) + " % of the frames with a true pose have one",
            "coverage", orNull(coverage));
  std::vector<double> sequences;
  for (const auto& [name, values] : by_sequence) sequences.push_back(statistics(values).mean);
  addClusterMean("ATE per sequence", "sequence_ate_rmse_mm", " mm", "sequences", sequences, &facts);
  if (sequences.size() < 3)
    facts.addLine("intervals", "none: a bootstrap over sequences needs three or more");
  facts.addQuietly("ranges", ranges);
  addLatency(latency_ms, "per frame, without the first of each run", &facts);
  return facts;
}

}  // namespace softscope
