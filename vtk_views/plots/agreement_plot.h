// vtk_views/plots/agreement_plot.h: differences
// with their limits of agreement (Bland, Altman).
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

/// Level with its confidence interval; NaN if undefined.
struct AgreementLevel {
  double value = 0, low = 0, high = 0;
};

/// One difference per case; computed elsewhere.
struct AgreementData {
  std::string title, x_label, y_label;
  std::vector<double> x, differences;
  AgreementLevel bias, low_limit, high_limit;
};

/// Dots, bias as a solid and limits as dashed lines, each in the band of its
/// confidence interval. Throws Error for different lengths or no finite pair.
VectorDrawing drawAgreement(const AgreementData& data, const PlotStyle& style = {});

}  // namespace softscope
