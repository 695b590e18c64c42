// toolkit/record/statistics_json.cpp: common keys of all records.
#include "toolkit/record/statistics_json.h"

#include <cmath>
#include <cstdio>

#include "toolkit/record/metric_lists.h"

namespace softscope {

FactSheet::Json statisticsJson(const Statistics& s, const std::string& unit) {
  FactSheet::Json json = FactSheet::Json::object();
  for (const Metric<Statistics>& metric : statisticsMetrics())
    json[metric.key + unit] = metric.of(s);
  json["n"] = s.count;
  return json;
}

FactSheet::Json vectorJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

FactSheet::Json orNull(double value) {
  return std::isfinite(value) ? FactSheet::Json(value) : FactSheet::Json(nullptr);
}

std::string csvCell(double value) {
  char text[32] = "";
  if (std::isfinite(value)) std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

FactSheet::Json matrixJson(const Eigen::Matrix4d& matrix) {
  FactSheet::Json rows = FactSheet::Json::array();
  for (int i = 0; i < 4; ++i) {
    FactSheet::Json row = FactSheet::Json::array();
    for (int j = 0; j < 4; ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

const char* stopText(AlignmentStop stop) {
  switch (stop) {
    case AlignmentStop::kConverged:
      return "converged";
    case AlignmentStop::kIterationLimit:
      return "iteration limit";
    case AlignmentStop::kTooFewPairs:
      return "too few pairs";
  }
  return "unknown";
}

std::string spreadText(const Statistics& s) {
  if (s.count == 0) return "not measured";
  return "mean " + fixed(s.mean, 3) + ", median " + fixed(s.median, 3) + ", P95 " +
         fixed(s.p95, 3) + ", max " + fixed(s.max, 2) + " mm";
}

}  // namespace softscope
