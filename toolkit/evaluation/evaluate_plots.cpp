// toolkit/evaluation/evaluate_plots.cpp: picks, counts and names.
#include "toolkit/evaluation/evaluate_plots.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "eval/histogram.h"

namespace softscope {
namespace {

constexpr int kBins = 60;
constexpr std::size_t kWorstFrames = 10;

std::string lastPart(const std::string& path) {
  std::filesystem::path place = std::filesystem::path(path).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  return place.filename().string();
}

/// Whether times tell the models apart.
bool timesRise(const SurfaceSeries& surface) {
  for (std::size_t i = 0; i < surface.models.size(); ++i)
    if (!std::isfinite(surface.models[i].time_s) ||
        (i > 0 && surface.models[i].time_s <= surface.models[i - 1].time_s))
      return false;
  return true;
}

/// 1, 2 or 5 times a power of ten, and its halves in between.
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
  const bool over_time = timesRise(result.surface);
  if (!over_time) data.time_label = "frame";
  for (const JudgedModel& model : result.surface.models) {
    data.times.push_back(over_time ? model.time_s : model.frame);
    data.mean.push_back(model.errors.distance_mm.mean);
    data.median.push_back(model.errors.distance_mm.median);
    data.p95.push_back(model.errors.distance_mm.p95);
  }
  return data;
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
