#include "toolkit/benchmark/depth_scores.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "eval/images/dense_answer.h"
#include "eval/images/pixel_masks.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

using PairValue = std::function<double(const DepthPairResult&)>;

constexpr std::size_t kBad2 = 1, kBad3 = 2;  // indices into the thresholds 1, 2, 3 px

/// Mean per group without NaNs, in the order of the names.
std::vector<double> groupMeans(const std::vector<DepthPairResult>& pairs, const PairValue& value) {
  std::map<std::string, std::vector<double>> groups;
  for (const DepthPairResult& pair : pairs)
    if (pair.excluded.empty()) groups[pair.group].push_back(value(pair));
  std::vector<double> means;
  for (const auto& [name, values] : groups) means.push_back(statistics(values).mean);
  return means;
}

double overall(const std::vector<DepthPairResult>& pairs, const PairValue& value) {
  return statistics(groupMeans(pairs, value)).mean;
}

double at(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : Statistics::kNone;
}

std::string textOr(double value, int digits) {
  return std::isfinite(value) ? fixed(value, digits) : std::string("-");
}

void addDepthRow(const std::string& label, const std::string& key,
                 const std::vector<DepthPairResult>& pairs, DepthErrors DepthPairResult::*errors,
                 FactSheet* facts) {
  const auto mean = [&](auto value) {
    return overall(pairs, [&](const DepthPairResult& pair) { return value(pair.*errors); });
  };
  const double mae = mean([](const DepthErrors& e) { return e.absolute_mm.mean; });
  const double median = mean([](const DepthErrors& e) { return e.absolute_mm.median; });
  const double rmse = mean([](const DepthErrors& e) { return e.absolute_mm.rmse; });
  const double bad_2 = mean([](const DepthErrors& e) { return at(e.bad_percent, kBad2); });
  const double bad_3 = mean([](const DepthErrors& e) { return at(e.bad_percent, kBad3); });
  const double coverage = mean([](const DepthErrors& e) { return e.coverage_percent; });
  facts->addLine(label, "MAE " + textOr(mae, 3) + "  median " + textOr(median, 3) + "  RMSE " +
                            textOr(rmse, 3) + " mm  > 2 mm " + textOr(bad_2, 1) + " %  > 3 mm " +
                            textOr(bad_3, 1) + " %  coverage " + textOr(coverage, 1) + " %");
  facts->addQuietly(key, {{"mae_mm", orNull(mae)},
                          {"median_mm", orNull(median)},
                          {"rmse_mm", orNull(rmse)},
                          {"bad_2_mm_percent", orNull(bad_2)},
                          {"bad_3_mm_percent", orNull(bad_3)},
                          {"coverage_percent", orNull(coverage)}});
}

void addDisparityRow(const std::vector<DepthPairResult>& pairs, FactSheet* facts) {
  const auto mean = [&](auto value) {
    return overall(pairs, [&](const DepthPairResult& pair) { return value(pair.measured_px); });
  };
  const double epe = mean([](const DisparityErrors& e) { return e.absolute_px.mean; });
  const double bad_2 = mean([](const DisparityErrors& e) { return at(e.bad_percent, kBad2); });
  const double bad_3 = mean([](const DisparityErrors& e) { return at(e.bad_percent, kBad3); });
  facts->addLine("disparity, measured", "EPE " + textOr(epe, 3) + " px  bad-2 " + textOr(bad_2, 1) +
                                            " %  bad-3 " + textOr(bad_3, 1) + " %");
  facts->addQuietly("disparity", {{"epe_px", orNull(epe)},
                                  {"bad_2_px_percent", orNull(bad_2)},
                                  {"bad_3_px_percent", orNull(bad_3)}});
}

void addPairs(const std::vector<DepthPairResult>& pairs, FactSheet* facts) {
  FactSheet::Json list = FactSheet::Json::array();
  for (const DepthPairResult& pair : pairs)
    if (pair.excluded.empty())
      list.push_back({{"pair", pair.name},
                      {"group", pair.group},
                      {"mae_mm", orNull(pair.measured.absolute_mm.mean)},
                      {"median_mm", orNull(pair.measured.absolute_mm.median)},
                      {"coverage_percent", orNull(pair.measured.coverage_percent)},
                      {"dense_mae_mm", orNull(pair.dense.absolute_mm.mean)},
                      {"known_share", orNull(pair.known_share)}});
  facts->addQuietly("pairs", list);
}

/// Over groups if there are three or more: the pairs of one group are not independent.
void addDepthIntervals(const std::vector<DepthPairResult>& pairs, FactSheet* facts) {
  const PairValue mae = [](const DepthPairResult& pair) { return pair.measured.absolute_mm.mean; };
  const PairValue gain = [](const DepthPairResult& pair) {
    return pair.control.absolute_mm.mean - pair.dense.absolute_mm.mean;
  };
  std::vector<double> errors = groupMeans(pairs, mae), gains = groupMeans(pairs, gain);
  const bool by_group = errors.size() >= 3;
  if (!by_group) {
    errors.clear();
    gains.clear();
    for (const DepthPairResult& pair : pairs) {
      if (!pair.excluded.empty()) continue;
      errors.push_back(mae(pair));
      gains.push_back(gain(pair));
    }
  }
  const std::string unit = by_group ? "group" : "pair";
  facts->addQuietly("bootstrap_over", by_group ? "groups" : "pairs");
  addClusterMean("MAE a " + unit, "cluster_mae_mm", " mm", unit + "s", errors, facts);
  addClusterMean("dense, below the control", "cluster_mae_mm_below_control", " mm", unit + "s",
                 gains, facts);
  if (errors.size() < 3) facts->addLine("intervals", "none: a bootstrap needs three or more pairs");
}

}  // namespace

void judgeDepthPair(const Raster<float>& measured_mm, const Raster<float>& truth_mm,
                    const RectifiedRig& rig, DepthPairResult* result) {
  requireSameShape(measured_mm, truth_mm, "depth map");
  std::vector<double> known;
  for (const float value : truth_mm.values)
    if (std::isfinite(value)) known.push_back(value);
  result->known_share = static_cast<double>(known.size()) /
                        static_cast<double>(std::max<std::size_t>(1, truth_mm.size()));
  if (known.empty() || result->known_share < kLeastKnownShare) {
    result->excluded = "truth is known of " + fixed(100 * result->known_share, 1) +
                       " % of the pixels, but 10 % are needed";
    return;
  }
  const Raster<float> truth_px = disparityFromDepth(truth_mm, rig);
  const Raster<float> filled_mm = fillFromNearest(measured_mm);
  const Mask hidden = hiddenInRight(truth_px);
  Mask seen = hidden;
  for (auto& value : seen.values) value = value == 0;
  const Raster<float> control_mm(truth_mm.width_px, truth_mm.height_px,
                                 static_cast<float>(statistics(known).median));
  result->measured = depthErrors(measured_mm, truth_mm);
  result->measured_px = disparityErrors(disparityFromDepth(measured_mm, rig), truth_px);
  result->dense = depthErrors(filled_mm, truth_mm);
  result->visible = depthErrors(measured_mm, truth_mm, {}, hidden);
  result->hidden = depthErrors(filled_mm, truth_mm, {}, seen);
  result->control = depthErrors(control_mm, truth_mm);
}

FactSheet depthBenchmarkFacts(const DepthBenchmarkResult& result) {
  FactSheet facts(result.title);
  std::vector<std::string> judged;
  std::vector<ExcludedClip> excluded;
  std::vector<double> latency_ms;
  for (const DepthPairResult& pair : result.pairs) {
    if (!pair.excluded.empty()) {
      excluded.push_back({pair.name, pair.excluded});
      continue;
    }
    judged.push_back(pair.name);
    if (std::isfinite(pair.latency_ms)) latency_ms.push_back(pair.latency_ms);
  }
  for (const std::string& warning : result.warnings) facts.warn(warning);
  addClips(judged, excluded, &facts);
  facts.add("protocol", "protocol",
            result.protocol +
                "; mean per pair, per group of pairs, over the groups; pairs with less than 10 % "
                "of truth are excluded");
  addDepthRow("measured", "measured", result.pairs, &DepthPairResult::measured, &facts);
  addDepthRow("dense", "dense", result.pairs, &DepthPairResult::dense, &facts);
  addDepthRow("no depth", "control", result.pairs, &DepthPairResult::control, &facts);
  addDepthRow("seen by both", "seen_by_both", result.pairs, &DepthPairResult::visible, &facts);
  addDepthRow("occluded, dense", "occluded_dense", result.pairs, &DepthPairResult::hidden, &facts);
  addDisparityRow(result.pairs, &facts);
  addDepthIntervals(result.pairs, &facts);
  addPairs(result.pairs, &facts);
  addLatency(latency_ms, "per pair, in its own process", &facts);
  return facts;
}

}  // namespace softscope
