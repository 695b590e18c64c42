// toolkit/report/write_report.h: page from folders of evaluations and comparisons.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolkit/report/report_document.h"

namespace softscope {

struct ReportOptions {
  std::vector<std::string> cases;   // folders written by an evaluation or comparison
  std::vector<std::string> versus;  // results of another method, one per case; empty: none
  std::vector<std::string> names;   // one per case; empty: numbered
  std::string title;
  double limit_mm = 0;  // end of the colour range; 0: a round number above the largest P95
  int seed = 1;         // of the bootstrap
  bool with_paths = false;
  std::string checklist;  // claim, stard-ai; empty: none
  std::vector<Threshold> thresholds;
  std::filesystem::path html, pdf;  // output files; `pdf` may be empty
  bool overwrite = false;

  /// Throws OptionError.
  void validate() const;
};

/// Both files are written, or neither. Throws OptionError and InputError.
ReportDocument writeReport(const ReportOptions& options);

}  // namespace softscope
