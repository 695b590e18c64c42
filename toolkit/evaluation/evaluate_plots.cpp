// toolkit/evaluation/evaluate_plots.cpp: selection of values, bins and titles.
#include "toolkit/evaluation/evaluate_plots.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "eval/statistics/histogram.h"

namespace softscope {
namespace {

constexpr int kBins = 60;
constexpr std::size_t kWorstFrames = 10;

std::string lastPart(const std::string& path) {
  std::filesystem::path place = std::filesystem::path(path).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  return place.filename().string();
}

/// True if every frame of the plots has a timestamp.
bool hasTimes(const EvaluationResult& result) {
  const auto& models = result.surface.models;
  return std::all_of(result.times_s.begin(), result.times_s.end(),
                     [](const auto& time) { return std::isfinite(time.second); }) &&
         std::all_of(models.begin(), models.end(),
                     [](const JudgedModel& model) { return std::isfinite(model.time_s); });
}

/// 1, 2 or 5 times a power of ten, and the midpoints between them.
double binEnd(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double leading : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (value <= leading * power) return leading * power;
  return 10 * power;
}

}  // namespace

ErrorSeriesData seriesData(const EvaluationResult& result) {
  ErrorSeriesData data;
  data.title = comparisonTitle(result.run, result.reference);
  const bool over_time = hasTimes(result);
  if (!over_time) data.time_label = "frame";
  std::map<int, const JudgedModel*> rows;  // null: no evaluated model
  for (const auto& [frame, time_s] : result.times_s)
    if (!result.outcomes.fused(frame) || frame == result.times_s.begin()->first ||
        frame == result.times_s.rbegin()->first)  // the axis covers the run
      rows[frame] = nullptr;
  for (const JudgedModel& model : result.surface.models) rows[model.frame] = &model;
  for (const auto& [frame, model] : rows) {
    const Statistics errors = model == nullptr ? Statistics() : model->errors.distance_mm;
    const double time_s = model == nullptr ? result.times_s.at(frame) : model->time_s;
    data.times.push_back(over_time ? time_s : frame);
    data.mean.push_back(errors.mean);
    data.median.push_back(errors.median);
    data.p95.push_back(errors.p95);
  }
  return data;
}

OutcomeStripData outcomeStrip(const EvaluationResult& result) {
  OutcomeStripData strip;
  const bool over_time = hasTimes(result);
  for (const auto& [frame, outcome] : result.outcomes.each()) {
    const auto time = result.times_s.find(frame);
    if (time == result.times_s.end()) continue;
    strip.x.push_back(over_time ? time->second : frame);
    strip.outcomes.push_back(outcome);
  }
  return strip;
}

WorstFramesData worstFramesData(const EvaluationResult& result) {
  std::vector<const JudgedModel*> models;
  for (const JudgedModel& model : result.surface.models) models.push_back(&model);
  std::stable_sort(models.begin(), models.end(), [](const JudgedModel* a, const JudgedModel* b) {
    return a->errors.distance_mm.mean > b->errors.distance_mm.mean;
  });
  if (models.size() > kWorstFrames) models.resize(kWorstFrames);
  WorstFramesData data;
  data.title = comparisonTitle(result.run, result.reference);
  for (const JudgedModel* model : models) {
    data.frames.push_back(model->frame);
    data.mean.push_back(model->errors.distance_mm.mean);
    data.p95.push_back(model->errors.distance_mm.p95);
  }
  return data;
}

Histogram countErrors(const std::vector<double>& errors_mm) {
  const double p99_mm = percentiles(errors_mm, {99})[0];
  return histogram(errors_mm, 0, binEnd(std::max(p99_mm, 1e-3)), kBins);
}

FactSheet::Json histogramJson(const std::vector<double>& errors_mm) {
  if (statistics(errors_mm).count == 0) return nullptr;
  const Histogram counted = countErrors(errors_mm);
  return {{"low_mm", counted.low},
          {"high_mm", counted.high},
          {"counts", counted.counts},
          {"beyond", counted.above}};
}

ErrorHistogramData histogramOf(const std::vector<double>& errors_mm, const std::string& title) {
  const Statistics all = statistics(errors_mm);
  const Histogram counted = countErrors(errors_mm);
  ErrorHistogramData data;
  data.title = title;
  data.high = counted.high;
  const auto total = static_cast<double>(counted.total);
  for (const std::size_t count : counted.counts)
    data.shares.push_back(static_cast<double>(count) / total);
  data.cumulative = counted.cumulativeShares();
  data.share_beyond = static_cast<double>(counted.above) / total;
  data.median = all.median;
  data.p95 = all.p95;
  return data;
}

std::string comparisonTitle(const std::string& test, const std::string& reference) {
  return lastPart(test) + " against " + lastPart(reference);
}

}  // namespace softscope
