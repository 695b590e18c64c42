// toolkit/evaluation/thresholds.h: `--fail-if 'p95_mm>2'`: limits that determine the exit code.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// The evaluation fails if `metric relation limit` is true.
struct Threshold {
  std::string metric;    // as given
  std::string relation;  // >, >=, < or <=
  double limit = 0;
  bool percent = false;  // given in percent: the metric is a share, the limit is divided by 100

  std::string text() const;
  /// Name of the metric in the record: `lost>10%` means lost_share.
  std::string name() const;
  bool fails(double value) const;  // true for NaN: a missing measurement fails
};

/// Throws OptionError unless the text is `name relation number`, with an optional %.
Threshold parseThreshold(const std::string& text);

/// Result of a threshold.
struct ThresholdOutcome {
  Threshold threshold;
  std::string path;  // path of the metric, "surface.p95_mm"
  double value = 0;  // NaN without a measurement
  bool failed = false;
};

/// Every number (or null) of a result by its path, with dots. Of the
/// lists only scores with a `tau_mm`, as "scores.0.5mm.recall".
std::vector<std::pair<std::string, double>> metricsOf(const FactSheet::Json& result);

/// Searches each metric by its path, by its name in the part `preferred`, or by a unique last
/// part of a path. Throws OptionError with the nearest name if there is none or several.
std::vector<ThresholdOutcome> checkThresholds(const std::vector<Threshold>& thresholds,
                                              const FactSheet::Json& result,
                                              const std::string& preferred);

FactSheet::Json thresholdsJson(const std::vector<ThresholdOutcome>& outcomes);

}  // namespace softscope
