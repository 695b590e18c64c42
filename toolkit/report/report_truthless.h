// toolkit/report/report_truthless.h: what a report says of a run without ground truth.
#pragma once

#include <string>
#include <vector>

#include "toolkit/report/report_plots.h"
#include "vtk_views/report/report_page.h"

namespace softscope {

/// Which moment drawn_view.png shows, how much the model covers, how old it is.
std::string drawnViewCaption(const ReportCase& c);
/// That nothing is known of the distance from the tissue; then what is known.
ReportParagraph truthlessHeadline(const ReportCase& c);
/// The same in a few words.
std::string truthlessSummary(const ReportCase& c);
ReportTiles truthlessTiles(const ReportCase& c);
/// The drawn view, back-projection, the scope's path; those that weren't measured are left out.
std::vector<ReportTable> truthlessTables(const ReportCase& c);
/// PSNR, SSIM, back-projection and the scope's steps over time.
std::vector<CaptionedFigure> truthlessFigures(const ReportCase& c);
std::vector<std::string> truthlessLimits(const ReportCase& c);
std::vector<std::string> truthlessMethods();

}  // namespace softscope
