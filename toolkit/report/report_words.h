// toolkit/report/report_words.h: formatting of numbers in reports.
#pragma once

#include <string>
#include <vector>

#include "eval/statistics/cohort.h"
#include "toolkit/report/report_case.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

/// "0.072"; an en dash for NaN. Decimals by size: 3
/// below 1, 2 below 100; two digits below 0.0005.
std::string numberText(double value);
std::string millimetresText(double value);           // "0.072 mm"
std::string percentText(double share);               // 0.984 is "98.4 %"
std::string intervalText(const Interval& interval);  // "0.05 to 0.09"

/// Definition of back-projection used in all texts: docs/evaluation.md, "Back-projection".
extern const char* const kBackProjectionMeaning;

/// One row per named part of the record with a mean: mean, SD, RMSE, median, P95, max, n.
struct NamedPart {
  std::string name, path;
};
ReportTable statisticsTable(const std::string& caption, const FactSheet::Json& record,
                            const std::vector<NamedPart>& parts);

/// Adds the table unless it is empty.
void addTable(ReportTable table, std::vector<ReportPart>& parts);

/// One value per row; missing values are omitted.
ReportTable valueTable(const std::string& caption, const std::string& heading,
                       const FactSheet::Json& record, const std::vector<NamedPart>& values);

/// Held-out views with their control; empty without held-out frames.
ReportTable heldOutTable(const FactSheet::Json& record);

}  // namespace softscope
