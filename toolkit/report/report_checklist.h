// toolkit/report/report_checklist.h: items of reporting guidelines, and their place here.
#pragma once

#include <string>

#include "vtk_views/report/report_page.h"

namespace softscope {

/// Throws OptionError unless empty (none), "claim" or "stard-ai".
void requireChecklist(const std::string& name);

/// One row per item: its number, its requirement in our
/// words, the place in this report, the part for the author.
ReportTable checklistTable(const std::string& name);

}  // namespace softscope
