// toolkit/report/report_alignment.h: alignment
// of the model, and its effect on the errors.
#pragma once

#include <string>
#include <vector>

#include "toolkit/report/report_case.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

bool wasAligned(const ReportCase& c);
/// One row of the table of compared items.
std::string alignmentText(const ReportCase& c);
/// Before and after; empty without alignment.
std::vector<ReportPart> alignmentParts(const ReportCase& c);

}  // namespace softscope
