// toolkit/evaluation/thresholds.h: `--fail-if 'p95_mm>2'`: limits that decide the exit code.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// One limit: the evaluation fails where `metric relation limit` holds.
struct Threshold {
  std::string metric;    // as the user wrote it
  std::string relation;  // >, >=, < or <=
  double limit = 0;
  bool percent = false;  // written as such: the metric is a share, the limit its hundredth

  std::string text() const;
  /// As it is looked up: `lost>10%` asks for lost_share.
  std::string name() const;
  bool fails(double value) const;  // a value that is NaN fails: what wasn't measured isn't good
};

/// Throws OptionError where the text is no `name relation number`, maybe with % at its end.
Threshold parseThreshold(const std::string& text);

/// What a threshold came to.
struct ThresholdOutcome {
  Threshold threshold;
  std::string path;  // of the metric, "surface.p95_mm"
  double value = 0;  // NaN where it wasn't measured
  bool failed = false;
};

/// Every number (or null) of a result by its path, with dots; lists are left out.
std::vector<std::pair<std::string, double>> metricsOf(const FactSheet::Json& result);

/// Finds each metric by its path, by its name in the part `preferred`, or by a last part that only
/// one path has. Throws OptionError with the nearest name where there is none, or several.
std::vector<ThresholdOutcome> checkThresholds(const std::vector<Threshold>& thresholds,
                                              const FactSheet::Json& result,
                                              const std::string& preferred);

FactSheet::Json thresholdsJson(const std::vector<ThresholdOutcome>& outcomes);

}  // namespace softscope
