// vtk_views/report/report_pdf.h: a report as PDF.
#pragma once

#include <string>

#include "vtk_views/report/report_page.h"

namespace softscope {

/// A PDF of A4 pages: text is text, plots are lines, the map is its image. The notice stands on
/// every page. The same page gives the same bytes.
std::string reportPdf(const ReportPage& page);

}  // namespace softscope
