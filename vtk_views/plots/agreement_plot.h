// vtk_views/plots/agreement_plot.h: differences and the limits that nearly all of them keep (Bland,
// Altman).
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

/// A level with its confidence interval; NaN where it is not defined.
struct AgreementLevel {
  double value = 0, low = 0, high = 0;
};

/// One difference a case; computed elsewhere.
struct AgreementData {
  std::string title, x_label, y_label;
  std::vector<double> x, differences;
  AgreementLevel bias, low_limit, high_limit;
};

/// Dots, the bias as a line and the limits dashed, each in the band of its confidence interval.
/// Throws Error where the lengths differ or there is no finite pair.
VectorDrawing drawAgreement(const AgreementData& data, const PlotStyle& style = {});

}  // namespace softscope
