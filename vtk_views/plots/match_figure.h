// vtk_views/plots/match_figure.h: matches between two images.
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

/// Row of the figure: two images side by side with lines between matches.
struct MatchPanel {
  std::string caption;  // below the row, after its letter
  std::vector<DrawnMatch> matches;
};

struct MatchFigure {
  ColourImage left, right;  // equal size in all rows
  std::string left_title, right_title;
  std::vector<MatchPanel> panels;
  std::string note;  // small text at the bottom, with line breaks
};

/// Every match is a dot in both images; at most `lines` per row are connected by a line,
/// evenly spread over the given order, with the true proportion of inliers and outliers.
/// Outliers are drawn on top. Throws Error without a panel or for images of different sizes.
VectorDrawing drawMatches(const MatchFigure& figure, const FigureStyle& style, int lines = 24);

}  // namespace softscope
