// toolkit/report/report_sections.h: one case in words, tables and plots, in the order in which it
// is read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "toolkit/report/report_case.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

struct ReportChoices {
  bool with_paths = false;  // else files and folders stay out
  std::uint64_t seed = 1;   // of resampling
  std::string checklist;    // of a reporting guideline; empty: none
};

/// What was compared and how it was aligned, as rows of a table.
ReportTable comparedTable(const ReportCase& c, const ReportChoices& choices);
/// The sentence, the large numbers, the tables; what the numbers rest on.
std::vector<ReportPart> resultParts(const ReportCase& c);
/// Mean, SD and so on of every part that was measured.
ReportTable distancesTable(const ReportCase& c, const std::string& caption);
/// Error over time, histogram.
std::vector<ReportPart> plotParts(const ReportCase& c);
/// What the numbers don't say.
ReportList limitsList(const ReportCase& c, const ReportChoices& choices);
/// Definitions of what is in the tables.
ReportList methodsList(const ReportCase& c);
/// Program, settings, hashes.
ReportTable provenanceTable(const ReportCase& c, const ReportChoices& choices);

}  // namespace softscope
