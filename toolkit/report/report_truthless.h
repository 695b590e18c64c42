// toolkit/report/report_truthless.h: report of a run without ground truth.
#pragma once

#include <string>
#include <vector>

#include "toolkit/report/report_plots.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

/// Caption of drawn_view.png: frame, completeness and age of the model.
std::string drawnViewCaption(const ReportCase& c);
/// States that the distance to the tissue is unknown, then the known values.
ReportParagraph truthlessHeadline(const ReportCase& c);
/// Short form of the headline.
std::string truthlessSummary(const ReportCase& c);
ReportTiles truthlessTiles(const ReportCase& c);
/// Rendered view, back-projection and camera path, without missing values.
std::vector<ReportTable> truthlessTables(const ReportCase& c);
/// PSNR, SSIM, back-projection and camera steps over time.
std::vector<CaptionedFigure> truthlessFigures(const ReportCase& c);
std::vector<std::string> truthlessLimits(const ReportCase& c);
std::vector<std::string> truthlessMethods();

}  // namespace softscope
