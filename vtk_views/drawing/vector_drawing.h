// vtk_views/drawing/vector_drawing.h: vector drawing of lines and text.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Points (1/72 inch) from the top left corner; x right, y down.
struct PointPt {
  double x_pt = 0, y_pt = 0;
};

inline constexpr double kPtPerMm = 72 / 25.4;

/// Polyline.
struct DrawnLine {
  std::vector<PointPt> points;
  double width_pt = 0.75;
  Rgb8 colour{20, 20, 20};
  bool dashed = false;
};

/// Filled polygon without outline.
struct DrawnShape {
  std::vector<PointPt> points;
  Rgb8 colour{200, 200, 200};
};

enum class TextAnchor { kStart, kMiddle, kEnd };

/// `at`: start, middle or end of the baseline.
struct DrawnText {
  PointPt at;
  std::string text;  // UTF-8
  double size_pt = 7;
  TextAnchor anchor = TextAnchor::kStart;
  bool bold = false;
  bool upwards = false;  // rotated, from bottom to top
  Rgb8 colour{20, 20, 20};
  /// Outline of letters, for readability over lines and images.
  std::optional<Rgb8> rim = std::nullopt;
};

/// Round dots of equal size and colour.
struct DrawnDots {
  std::vector<PointPt> centres;
  double diameter_pt = 1;
  Rgb8 colour{20, 20, 20};
};

/// Image, scaled to the box between two corners; `smooth` interpolates.
struct DrawnPicture {
  PointPt top_left, bottom_right;
  ColourImage picture;
};

/// Parts in drawing order, on white.
struct VectorDrawing {
  double width_pt = 0, height_pt = 0;
  std::vector<std::variant<DrawnLine, DrawnShape, DrawnText, DrawnDots, DrawnPicture>> parts;
};

/// Appends `below` under `drawing`; the result has the larger width.
void appendBelow(const VectorDrawing& below, double gap_pt, VectorDrawing& drawing);

/// In the font of all figures.
double textWidthPt(const DrawnText& text);

// Deterministic. SVG and PDF contain vector lines and text; a PDF
// embeds its font, both embed their images. All throw Error for a
// drawing without a size, or of a size that cairo does not support.

std::string svgBytes(const VectorDrawing& drawing);
std::string pdfBytes(const VectorDrawing& drawing);
/// One page per drawing; at least one.
std::string pdfOfPages(const std::vector<VectorDrawing>& pages);
ColourImage rasterise(const VectorDrawing& drawing, double dots_per_inch);

}  // namespace softscope
