// toolkit/report/write_report.h: folders of evaluations and comparisons to a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolkit/report/report_document.h"

namespace softscope {

struct ReportOptions {
  std::vector<std::string> cases;   // folders that an evaluation or a comparison wrote
  std::vector<std::string> versus;  // another method's result of each case; empty: none
  std::vector<std::string> names;   // of each case; empty: numbered
  std::string title;
  double limit_mm = 0;  // where the colours end; 0: a round number above the largest P95
  int seed = 1;         // of resampling for confidence intervals
  bool with_paths = false;
  std::string checklist;  // claim, stard-ai; empty: none
  std::vector<Threshold> thresholds;
  std::filesystem::path html, pdf;  // files; `pdf` may be empty
  bool overwrite = false;

  /// Throws OptionError.
  void validate() const;
};

/// Both files appear, or neither. Throws OptionError and InputError.
ReportDocument writeReport(const ReportOptions& options);

}  // namespace softscope
