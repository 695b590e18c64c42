// toolkit/record/metric_lists.h: the numbers of each result struct with their keys, listed once.
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

/// A number of a result. Records, tables and reports walk the lists below, in their order.
template <class Result>
struct Metric {
  const char* key;  // with its unit, but for Statistics
  double (*of)(const Result&);
  const char* name = "";  // in tables of the report; empty where none has it alone
};
template <class Result>
using MetricList = std::vector<Metric<Result>>;

/// The unit follows each key: "mean" + "_mm".
const MetricList<Statistics>& statisticsMetrics();
const MetricList<HausdorffDistances>& hausdorffMetrics();
/// How much of the tissue the model covers.
const MetricList<ModelErrors>& completenessMetrics();
/// Of the model drawn into the image.
const MetricList<DepthErrors>& drawnDepthMetrics();
const MetricList<PictureErrors>& drawnViewMetrics();

/// An object of all numbers; `value` gives that of a metric.
template <class Result, class Value>
FactSheet::Json metricsJson(const MetricList<Result>& metrics, const Value& value) {
  FactSheet::Json json = FactSheet::Json::object();
  for (const Metric<Result>& metric : metrics) json[metric.key] = value(metric);
  return json;
}

/// Of one result.
template <class Result>
FactSheet::Json metricsJson(const MetricList<Result>& metrics, const Result& result) {
  return metricsJson(metrics, [&](const Metric<Result>& metric) { return metric.of(result); });
}

}  // namespace softscope
