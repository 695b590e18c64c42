// toolkit/report/report_sections.h: texts, tables
// and plots of one case, in reading order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "toolkit/report/report_case.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

struct ReportChoices {
  bool with_paths = false;  // else files and folders are removed
  std::uint64_t seed = 1;   // of resampling
  std::string checklist;    // reporting guideline; empty: none
};

/// Compared items and their alignment, as a table.
ReportTable comparedTable(const ReportCase& c, const ReportChoices& choices);
/// Summary sentence, main numbers, tables and number of frames.
std::vector<ReportPart> resultParts(const ReportCase& c);
/// Mean, SD and other statistics of every measured part.
ReportTable distancesTable(const ReportCase& c, const std::string& caption);
/// Error over time, histogram.
std::vector<ReportPart> plotParts(const ReportCase& c);
/// Limits of the metrics.
ReportList limitsList(const ReportCase& c, const ReportChoices& choices);
/// Definitions of the metrics in the tables.
ReportList methodsList(const ReportCase& c);
/// Program, settings and hashes.
ReportTable provenanceTable(const ReportCase& c, const ReportChoices& choices);

}  // namespace softscope
