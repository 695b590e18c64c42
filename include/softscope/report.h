// include/softscope/report.h: page of evaluations and comparisons.
#pragma once

#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

struct ReportSettings {
  std::vector<std::string> names;  // one per case; empty: numbered
  std::string title;
  std::string pdf;          // PDF of the same page; empty: none
  double limit_mm = 0;      // end of the colour range; 0: a round number above the largest P95
  int seed = 1;             // of the bootstrap
  bool with_paths = false;  // with names of inputs
  bool overwrite = false;
};

/// `cases`: folders written by evaluate() (EvaluationOptions::out) or
/// `softscope compare --out`. Writes the page to the file `html`; returns
/// warnings about missing figures. Throws OptionError and InputError.
std::vector<std::string> report(const std::vector<std::string>& cases, const std::string& html,
                                const ReportSettings& settings = {});

}  // namespace softscope::api
