// vtk_views/report/report_html.h: a report as one self-contained HTML page.
#pragma once

#include <string>

#include "vtk_views/report/report_page.h"

namespace softscope {

/// HTML with style, scripts, plots, images, maps and metrics inside: it opens from disk and asks
/// the network for nothing. The same page gives the same bytes.
std::string reportHtml(const ReportPage& page);

}  // namespace softscope
