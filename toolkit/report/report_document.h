// toolkit/report/report_document.h: cases to page, metrics and lines.
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
  std::vector<std::vector<ThresholdOutcome>> outcomes;  // one list a case
  std::string title;                                    // empty: by what was compared
  double limit_mm = 0;                                  // of colours; 0: chosen
  ReportChoices choices;
};

struct ReportDocument {
  ReportPage page;
  FactSheet::Json metrics;  // schema_version 1; without paths unless they were asked for
  FactSheet facts{"report"};
  std::vector<ThresholdOutcome> outcomes;  // of all cases
  std::vector<std::string> warnings;       // of what the page lacks
};

ReportDocument makeReport(ReportRequest request);

}  // namespace softscope
