// include/softscope/report.h: evaluations and comparisons as one page for people.
#pragma once

#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

struct ReportSettings {
  std::vector<std::string> names;  // of each case; empty: numbered
  std::string title;
  std::string pdf;          // file of the same page on paper; empty: none
  double limit_mm = 0;      // where the colours end; 0: a round number above the largest P95
  int seed = 1;             // of resampling for confidence intervals
  bool with_paths = false;  // show the names of inputs
  bool overwrite = false;
};

/// `cases`: folders that evaluate() wrote (EvaluationOptions::out) or `softscope compare --out`.
/// Writes the page to the file `html`; returns what it could not draw. Throws OptionError and
/// InputError.
std::vector<std::string> report(const std::vector<std::string>& cases, const std::string& html,
                                const ReportSettings& settings = {});

}  // namespace softscope::api
