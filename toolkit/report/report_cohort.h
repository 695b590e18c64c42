// toolkit/report/report_cohort.h: report of several cases.
#pragma once

#include <vector>

#include "toolkit/report/report_case.h"
#include "toolkit/report/report_sections.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

/// Metric of a case, for each kind of record.
struct CohortMetric {
  const char* key;      // in JSON
  const char* name;     // with its unit
  const char* of_run;   // path in evaluation.json
  const char* of_pair;  // path in comparison.json; empty if absent
};

const std::vector<CohortMetric>& cohortMetrics();

/// True if any case has a reference.
bool anyTruth(const std::vector<ReportCase>& cases);

/// Compared items, one row per case.
ReportTable cohortComparedTable(const std::vector<ReportCase>& cases);

/// Summary sentence, main numbers, one row per case, one row per metric with mean
/// +- SD, median [IQR] and bootstrap interval, and the agreement of the surfaces.
std::vector<ReportPart> cohortParts(const std::vector<ReportCase>& cases,
                                    const ReportChoices& choices);

/// Paired comparison with the results of a second method for the same cases; as many as `cases`.
std::vector<ReportPart> pairedParts(const std::vector<ReportCase>& cases,
                                    const std::vector<ReportCase>& versus,
                                    const ReportChoices& choices);

/// Statistical methods for cohorts.
ReportList cohortMethods(bool paired);

/// The same numbers as JSON.
FactSheet::Json cohortJson(const std::vector<ReportCase>& cases,
                           const std::vector<ReportCase>& versus, const ReportChoices& choices);

}  // namespace softscope
