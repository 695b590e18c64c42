// toolkit/report/report_words.h: numbers as a report says them.
#pragma once

#include <string>
#include <vector>

#include "eval/statistics/cohort.h"
#include "toolkit/report/report_case.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

/// "0.072"; an en dash where it wasn't measured. Decimals by size: 3 below 1, 2 below 100; two
/// digits below 0.0005.
std::string numberText(double value);
std::string millimetresText(double value);           // "0.072 mm"
std::string percentText(double share);               // 0.984 is "98.4 %"
std::string intervalText(const Interval& interval);  // "0.05 to 0.09"

/// What back-projection is, wherever a text says it: docs/evaluation.md, "Back-projection".
extern const char* const kBackProjectionMeaning;

/// One row a named part of the record that has a mean: mean, SD, RMSE, median, P95, max, n.
struct NamedPart {
  std::string name, path;
};
ReportTable statisticsTable(const std::string& caption, const FactSheet::Json& record,
                            const std::vector<NamedPart>& parts);

/// Leaves a table without rows out.
void addTable(ReportTable table, std::vector<ReportPart>& parts);

/// Rows of one value each; those that weren't measured are left out.
ReportTable valueTable(const std::string& caption, const std::string& heading,
                       const FactSheet::Json& record, const std::vector<NamedPart>& values);

/// Views that the run did not see, with their control; without rows where no frame was held out.
ReportTable heldOutTable(const FactSheet::Json& record);

}  // namespace softscope
