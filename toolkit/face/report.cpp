// toolkit/face/report.cpp: implementation of include/softscope/report.h.
#include "softscope/report.h"

#include "toolkit/report/write_report.h"

namespace softscope::api {

std::vector<std::string> report(const std::vector<std::string>& cases, const std::string& html,
                                const ReportSettings& settings) {
  require(!cases.empty(), "cases", "empty", "a report needs one or more folders");
  ReportOptions options;
  options.cases = cases;
  options.names = settings.names;
  options.title = settings.title;
  options.limit_mm = settings.limit_mm;
  options.seed = settings.seed;
  options.with_paths = settings.with_paths;
  options.html = html;
  options.pdf = settings.pdf;
  options.overwrite = settings.overwrite;
  return writeReport(options).warnings;
}

}  // namespace softscope::api
