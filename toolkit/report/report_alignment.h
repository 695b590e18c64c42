// toolkit/report/report_alignment.h: how the model came to its place, and what that did to its
// errors.
#pragma once

#include <string>
#include <vector>

#include "toolkit/report/report_case.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

bool wasAligned(const ReportCase& c);
/// One line for the table of what was compared.
std::string alignmentText(const ReportCase& c);
/// Before and after; empty where nothing was aligned.
std::vector<ReportPart> alignmentParts(const ReportCase& c);

}  // namespace softscope
