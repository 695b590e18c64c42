// toolkit/report/report_cohort.h: several cases together.
#pragma once

#include <vector>

#include "toolkit/report/report_case.h"
#include "toolkit/report/report_sections.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

/// One number of a case, wherever its kind of record has it.
struct CohortMetric {
  const char* key;      // in JSON
  const char* name;     // with its unit
  const char* of_run;   // its place in evaluation.json
  const char* of_pair;  // in comparison.json; empty where that has none
};

const std::vector<CohortMetric>& cohortMetrics();

/// Whether any case was measured against something that is known.
bool anyTruth(const std::vector<ReportCase>& cases);

/// What was compared, a row a case.
ReportTable cohortComparedTable(const std::vector<ReportCase>& cases);

/// The sentence, the large numbers, a row a case, a row a metric with mean +- SD, median [IQR] and
/// bootstrap interval, and the agreement of the surfaces.
std::vector<ReportPart> cohortParts(const std::vector<ReportCase>& cases,
                                    const ReportChoices& choices);

/// Case by case against a second method's results for the same cases; as many as `cases`.
std::vector<ReportPart> pairedParts(const std::vector<ReportCase>& cases,
                                    const std::vector<ReportCase>& versus,
                                    const ReportChoices& choices);

/// How cohorts are summed up.
ReportList cohortMethods(bool paired);

/// The same numbers for programs.
FactSheet::Json cohortJson(const std::vector<ReportCase>& cases,
                           const std::vector<ReportCase>& versus, const ReportChoices& choices);

}  // namespace softscope
