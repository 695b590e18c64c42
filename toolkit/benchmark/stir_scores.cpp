#include "toolkit/benchmark/stir_scores.h"

#include <cmath>

#include "eval/statistics/cohort.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

struct Pool {
  std::vector<JudgedPoint> points_mm, control_mm, points_px, control_px;
  std::vector<double> latency_ms, error_mm, clip_aj, clip_gain;
  std::size_t extrapolated = 0;
};

Pool poolOf(const StirBenchmarkResult& result) {
  Pool pool;
  const auto add = [](const auto& from, auto* to) {
    to->insert(to->end(), from.begin(), from.end());
  };
  for (const StirClipResult& clip : result.clips) {
    if (!clip.excluded.empty()) continue;
    add(clip.points_mm, &pool.points_mm);
    add(clip.control_mm, &pool.control_mm);
    add(clip.points_px, &pool.points_px);
    add(clip.control_px, &pool.control_px);
    add(clip.latency_ms, &pool.latency_ms);
    add(clip.error_mm, &pool.error_mm);
    pool.extrapolated += clip.extrapolated;
    const double aj = trackingScores(clip.points_mm, trackingThresholdsMm()).average_jaccard;
    pool.clip_aj.push_back(aj);
    pool.clip_gain.push_back(
        aj - trackingScores(clip.control_mm, trackingThresholdsMm()).average_jaccard);
  }
  return pool;
}

void addRow(const std::string& label, const std::string& key,
            const std::vector<JudgedPoint>& points, const std::vector<double>& thresholds,
            FactSheet* facts) {
  const TrackingScores scores = trackingScores(points, thresholds);
  facts->addLine(label, "AJ " + fixed(scores.average_jaccard, 4) + "  ATA " +
                            fixed(scores.average_accuracy, 4) + "  OA " +
                            fixed(scores.occlusion_accuracy, 4));
  Json at = Json::array(), accuracy = Json::array();
  for (const double value : scores.jaccard_at) at.push_back(orNull(value));
  for (const double value : scores.accuracy_at) accuracy.push_back(orNull(value));
  facts->addQuietly(key, Json{{"aj", orNull(scores.average_jaccard)},
                              {"ata", orNull(scores.average_accuracy)},
                              {"oa", orNull(scores.occlusion_accuracy)},
                              {"points", scores.count},
                              {"jaccard_at", at},
                              {"accuracy_at", accuracy}});
}

Json intervalJson(const Interval& interval) {
  return {orNull(interval.low), orNull(interval.high)};
}

void addIntervals(const Pool& pool, FactSheet* facts) {
  const CohortSummary clips = summariseCohort(pool.clip_aj, kBenchmarkSeed);
  const CohortSummary gain = summariseCohort(pool.clip_gain, kBenchmarkSeed);
  facts->addQuietly("clip_aj_3d", Json{{"mean", orNull(clips.mean)},
                                       {"ci_95", intervalJson(clips.mean_ci)},
                                       {"over_control", orNull(gain.mean)},
                                       {"over_control_ci_95", intervalJson(gain.mean_ci)}});
  if (std::isfinite(clips.mean_ci.low))
    facts->addLine("AJ 3-D per clip",
                   fixed(clips.mean, 4) + " [" + fixed(clips.mean_ci.low, 4) + ", " +
                       fixed(clips.mean_ci.high, 4) + "], over the control " + fixed(gain.mean, 4) +
                       " [" + fixed(gain.mean_ci.low, 4) + ", " + fixed(gain.mean_ci.high, 4) +
                       "] (95 %, bootstrap over clips)");
  else
    facts->addLine("intervals", "none: a bootstrap over clips needs three or more");
}

}  // namespace

FactSheet stirBenchmarkFacts(const StirBenchmarkResult& result) {
  const Pool pool = poolOf(result);
  FactSheet facts("STIR 2026");
  std::vector<std::string> judged;
  std::vector<ExcludedClip> excluded;
  for (const StirClipResult& clip : result.clips) {
    if (clip.excluded.empty())
      judged.push_back(clip.name);
    else
      excluded.push_back({clip.name, clip.excluded});
  }
  addClips(judged, excluded, &facts);
  facts.add(
      "protocol", "protocol",
      std::string("all points of all frames but the first in one pool, truth from "
                  "annotations.json, within: error < 2, 4, 8, 16, 32 mm (3-D, visible in both "
                  "views) or px (2-D, visible in the left view)"));
  addRow("3-D", "scores_3d", pool.points_mm, trackingThresholdsMm(), &facts);
  addRow("3-D, nothing moves", "control_3d", pool.control_mm, trackingThresholdsMm(), &facts);
  addRow("2-D", "scores_2d", pool.points_px, trackingThresholdsPx(), &facts);
  addRow("2-D, nothing moves", "control_2d", pool.control_px, trackingThresholdsPx(), &facts);
  addIntervals(pool, &facts);
  const Statistics error = statistics(pool.error_mm);
  facts.add("error of measured points",
            "mean " + fixed(error.mean, 3) + " mm, median " + fixed(error.median, 3) + " mm",
            "measured_error.mean_mm", orNull(error.mean));
  facts.addQuietly("measured_error.median_mm", orNull(error.median));
  facts.addQuietly("measured_error.count", error.count);
  facts.add("extrapolated", "extrapolated_points", static_cast<int>(pool.extrapolated));
  addLatency(pool.latency_ms, "without the first " + std::to_string(kStirWarmUpFrames) + " frames",
             &facts);
  return facts;
}

}  // namespace softscope
