// toolkit/record/statistics_json.h: common parts of the records of evaluate and compare.
#pragma once

#include <string>

#include "eval/statistics/statistics.h"
#include "eval/surfaces/surface_alignment.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// mean, sd, rmse, median, p95, max with the unit as suffix, and n; null for NaN.
FactSheet::Json statisticsJson(const Statistics& s, const std::string& unit);

/// x, y, z.
FactSheet::Json vectorJson(const Eigen::Vector3d& v);

/// Four rows of four numbers.
FactSheet::Json matrixJson(const Eigen::Matrix4d& matrix);

/// null if it is not finite.
FactSheet::Json orNull(double value);

/// Nine digits of a value of a CSV file; empty if it is not finite.
std::string csvCell(double value);

const char* stopText(AlignmentStop stop);

/// "mean 0.171, median 0.133, P95 0.419, max 4.50 mm", or "not measured".
std::string spreadText(const Statistics& s);

}  // namespace softscope
