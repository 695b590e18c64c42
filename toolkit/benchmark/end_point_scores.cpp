#include "toolkit/benchmark/end_point_scores.h"

#include <cmath>

#include "eval/motion/tracking_scores.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

using Distances = std::vector<double> EndPointClipResult::*;

/// Image or 3-D.
struct EndPointSpace {
  std::string label, suffix, unit;  // 2-D, 2d, px
  std::vector<double> thresholds;
  Distances found, control;

  bool holds(const EndPointClipResult& clip) const {
    return clip.excluded.empty() && (unit == "px" || clip.without_3d.empty());
  }
  double delta(const std::vector<double>& distances) const {
    return endPointScores(distances, thresholds).average_accuracy;
  }
};

std::vector<double> pooled(const EndPointBenchmarkResult& result, const EndPointSpace& space,
                           Distances part) {
  std::vector<double> all;
  for (const EndPointClipResult& clip : result.clips)
    if (space.holds(clip)) all.insert(all.end(), (clip.*part).begin(), (clip.*part).end());
  return all;
}

void addEndPoints(const std::string& label, const std::string& key, const EndPointSpace& space,
                  const std::vector<double>& distances, FactSheet* facts) {
  if (distances.empty()) return;
  const EndPointScores scores = endPointScores(distances, space.thresholds);
  facts->addLine(label, "delta_avg " + fixed(scores.average_accuracy, 4) + "  mean " +
                            fixed(scores.distance.mean, 2) + "  median " +
                            fixed(scores.distance.median, 2) + " " + space.unit);
  facts->addQuietly(key, {{"delta_avg", orNull(scores.average_accuracy)},
                          {"accuracy_at", scores.accuracy_at},
                          {"mean_" + space.unit, orNull(scores.distance.mean)},
                          {"median_" + space.unit, orNull(scores.distance.median)},
                          {"points", scores.distance.count}});
}

void addEndPointIntervals(const EndPointBenchmarkResult& result, const EndPointSpace& space,
                          FactSheet* facts) {
  std::vector<double> delta, gain;
  for (const EndPointClipResult& clip : result.clips) {
    if (!space.holds(clip)) continue;
    delta.push_back(space.delta(clip.*space.found));
    gain.push_back(delta.back() - space.delta(clip.*space.control));
  }
  const std::string key = "clip_delta_avg_" + space.suffix;
  addClusterMean("delta_avg per sequence, " + space.label, key, "", "sequences", delta, facts);
  addClusterMean("over the control, " + space.label, key + "_over_control", "", "sequences", gain,
                 facts);
  if (delta.size() < 3)
    facts->addLine("intervals, " + space.label,
                   "none: a bootstrap over sequences needs three or more");
}

}  // namespace

FactSheet endPointFacts(const EndPointBenchmarkResult& result) {
  std::vector<std::string> judged;
  std::vector<ExcludedClip> excluded;
  std::vector<double> latency_ms;
  int points = 0, measured = 0;
  FactSheet facts("STIR (to 2025)");
  FactSheet::Json without = FactSheet::Json::array();
  for (const EndPointClipResult& clip : result.clips) {
    if (!clip.excluded.empty()) {
      excluded.push_back({clip.name, clip.excluded});
      continue;
    }
    judged.push_back(clip.name);
    latency_ms.insert(latency_ms.end(), clip.latency_ms.begin(), clip.latency_ms.end());
    points += clip.points;
    measured += clip.measured;
    if (clip.without_3d.empty()) continue;
    without.push_back({{"clip", clip.name}, {"why", clip.without_3d}});
    facts.warn("no 3-D score: " + clip.name + ": " + clip.without_3d);
  }
  addClips(judged, excluded, &facts);
  facts.addQuietly("without_3d", without);
  facts.add("protocol", "protocol",
            std::string("centres of the bounding boxes of the tattoos, all sequences in one pool; "
                        "distance of the last position from the nearest true end point: in the "
                        "left image, <= 4, 8, 16, 32, 64 px; in 3-D, <= 2, 4, 8, 16, 32 mm, for "
                        "tattoos with a partner in the right image"));
  const EndPointSpace spaces[] = {{"2-D", "2d", "px", endPointThresholdsPx(),
                                   &EndPointClipResult::found_px, &EndPointClipResult::control_px},
                                  {"3-D", "3d", "mm", endPointThresholdsMm(),
                                   &EndPointClipResult::found_mm, &EndPointClipResult::control_mm}};
  for (const EndPointSpace& space : spaces) {
    addEndPoints(space.label, "scores_" + space.suffix, space, pooled(result, space, space.found),
                 &facts);
    addEndPoints(space.label + ", nothing moves", "control_" + space.suffix, space,
                 pooled(result, space, space.control), &facts);
  }
  const double coverage = points == 0 ? std::nan("") : static_cast<double>(measured) / points;
  facts.add("coverage",
            fixed(100 * coverage, 1) +
                " % of the points have an end point; the others keep their first position",
            "coverage", orNull(coverage));
  for (const EndPointSpace& space : spaces) addEndPointIntervals(result, space, &facts);
  addLatency(latency_ms, "per frame, without the first of each run", &facts);
  return facts;
}

}  // namespace softscope
