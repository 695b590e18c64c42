// toolkit/report/report_document.h: page, metrics and text of a report.
#pragma once

#include <string>
#include <vector>

#include "toolkit/evaluation/thresholds.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/report/report_case.h"
#include "toolkit/report/report_sections.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

struct ReportRequest {
  std::vector<ReportCase> cases;                        // one or more
  std::vector<ReportCase> versus;                       // empty, or as many as the cases
  std::vector<std::vector<ThresholdOutcome>> outcomes;  // one list per case
  std::string title;                                    // empty: derived from the comparison
  double limit_mm = 0;                                  // of colours; 0: automatic
  ReportChoices choices;
};

struct ReportDocument {
  ReportPage page;
  FactSheet::Json metrics;  // schema_version 1; without paths by default
  FactSheet facts{"report"};
  std::vector<ThresholdOutcome> outcomes;  // of all cases
  std::vector<std::string> warnings;       // about missing parts of the page
};

ReportDocument makeReport(ReportRequest request);

}  // namespace softscope
