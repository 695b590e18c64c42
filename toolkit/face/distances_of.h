// toolkit/face/distances_of.h: conversion of statistics and metrics to the public interface.
#pragma once

#include <map>
#include <string>

#include "eval/statistics/statistics.h"
#include "softscope/evaluate.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope::api {

inline Distances distancesOf(const Statistics& s) {
  return {s.mean, s.sd, s.rmse, s.median, s.p95, s.max, static_cast<long>(s.count)};
}

inline std::map<std::string, double> metricMapOf(const FactSheet::Json& record) {
  std::map<std::string, double> metrics;
  for (const auto& [path, value] : metricsOf(record)) metrics[path] = value;
  return metrics;
}

}  // namespace softscope::api
