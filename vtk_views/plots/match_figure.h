// vtk_views/plots/match_figure.h: which pixel of one image was found where in another.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.h"
#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

struct DrawnMatch {
  Eigen::Vector2f left_px, right_px;  // (0, 0) is the centre of the top-left pixel
  bool inlier = false;
};

/// One row of the figure: two images side by side and what joins them.
struct MatchPanel {
  std::string caption;  // below, after its letter
  std::vector<DrawnMatch> matches;
};

struct MatchFigure {
  ColourImage left, right;  // of one size, the same in every row
  std::string left_title, right_title;
  std::vector<MatchPanel> panels;
  std::string note;  // small, at the bottom, in as many lines as it takes
};

/// Every match is a dot in both images; of each row at most `lines` are joined by a line, evenly
/// spread over the given order, inliers and outliers in their true proportion. Outliers lie on top.
/// Throws Error where there is no panel or the images differ in size.
VectorDrawing drawMatches(const MatchFigure& figure, const FigureStyle& style, int lines = 24);

}  // namespace softscope
