// toolkit/report/report_checklist.h: what a reporting guideline asks for, and where it stands here.
#pragma once

#include <string>

#include "vtk_views/report/report_page.h"

namespace softscope {

/// Throws OptionError unless empty (none), "claim" or "stard-ai".
void requireChecklist(const std::string& name);

/// A row per item: its number, what it asks for in our words, where this report says it, and what
/// is left to the author.
ReportTable checklistTable(const std::string& name);

}  // namespace softscope
