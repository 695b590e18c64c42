// vtk_views/report/report_pdf.h: a report as PDF.
#pragma once

#include <string>

#include "vtk_views/report/report_page.h"

namespace softscope {

/// PDF of A4 pages with text, vector plots, and an image
/// of the map. The notice is on every page. Deterministic.
std::string reportPdf(const ReportPage& page);

}  // namespace softscope
