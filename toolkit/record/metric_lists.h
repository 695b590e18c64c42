// toolkit/record/metric_lists.h: metrics of each result struct with their keys, declared once.
#pragma once

#include <string>
#include <vector>

#include "eval/images/depth_errors.h"
#include "eval/images/picture_errors.h"
#include "eval/statistics/statistics.h"
#include "eval/surfaces/hausdorff.h"
#include "eval/surfaces/model_errors.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Metric of a result. Records, tables and reports iterate over the lists below in their order.
template <class Result>
struct Metric {
  const char* key;  // with its unit, except for Statistics
  double (*of)(const Result&);
  const char* name = "";  // in tables of the report; empty if unused there
};
template <class Result>
using MetricList = std::vector<Metric<Result>>;

/// The unit is appended to each key: "mean" + "_mm".
const MetricList<Statistics>& statisticsMetrics();
const MetricList<HausdorffDistances>& hausdorffMetrics();
/// Completeness of the model.
const MetricList<ModelErrors>& completenessMetrics();
/// Of the rendered model.
const MetricList<DepthErrors>& drawnDepthMetrics();
const MetricList<PictureErrors>& drawnViewMetrics();

/// JSON object of all metrics; `value` returns the value of a metric.
template <class Result, class Value>
FactSheet::Json metricsJson(const MetricList<Result>& metrics, const Value& value) {
  FactSheet::Json json = FactSheet::Json::object();
  for (const Metric<Result>& metric : metrics) json[metric.key] = value(metric);
  return json;
}

/// For one result.
template <class Result>
FactSheet::Json metricsJson(const MetricList<Result>& metrics, const Result& result) {
  return metricsJson(metrics, [&](const Metric<Result>& metric) { return metric.of(result); });
}

}  // namespace softscope
