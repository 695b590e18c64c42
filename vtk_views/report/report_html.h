// vtk_views/report/report_html.h: a report as one self-contained HTML page.
#pragma once

#include <string>

#include "vtk_views/report/report_page.h"

namespace softscope {

/// HTML with embedded style, scripts, plots, images, maps and
/// metrics: it opens from disk without network access. Deterministic.
std::string reportHtml(const ReportPage& page);

}  // namespace softscope
