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

/// A line through points.
struct DrawnLine {
  std::vector<PointPt> points;
  double width_pt = 0.75;
  Rgb8 colour{20, 20, 20};
  bool dashed = false;
};

/// A closed, filled shape without an outline.
struct DrawnShape {
  std::vector<PointPt> points;
  Rgb8 colour{200, 200, 200};
};

enum class TextAnchor { kStart, kMiddle, kEnd };

/// `at` is on the baseline: the text's start, middle or end.
struct DrawnText {
  PointPt at;
  std::string text;  // UTF-8
  double size_pt = 7;
  TextAnchor anchor = TextAnchor::kStart;
  bool bold = false;
  bool upwards = false;  // reads from the bottom to the top
  Rgb8 colour{20, 20, 20};
  /// Around each letter, so that it is read over lines and images.
  std::optional<Rgb8> rim = std::nullopt;
};

/// Round dots of one size and colour.
struct DrawnDots {
  std::vector<PointPt> centres;
  double diameter_pt = 1;
  Rgb8 colour{20, 20, 20};
};

/// Pixels, stretched over the box between two corners; smooth between pixels.
struct DrawnPicture {
  PointPt top_left, bottom_right;
  ColourImage picture;
};

/// Later parts lie over earlier ones, on white.
struct VectorDrawing {
  double width_pt = 0, height_pt = 0;
  std::vector<std::variant<DrawnLine, DrawnShape, DrawnText, DrawnDots, DrawnPicture>> parts;
};

/// Puts `below` under `drawing`, which grows; the sheet keeps the wider width.
void appendBelow(const VectorDrawing& below, double gap_pt, VectorDrawing& drawing);

/// In the font that every figure is set in.
double textWidthPt(const DrawnText& text);

// The same drawing gives the same bytes. Lines are lines and text stays text in SVG and PDF; a PDF
// carries its font, and both carry their images. All throw Error for a drawing without a size, or
// one that cairo refuses.

std::string svgBytes(const VectorDrawing& drawing);
std::string pdfBytes(const VectorDrawing& drawing);
/// One page a drawing; at least one.
std::string pdfOfPages(const std::vector<VectorDrawing>& pages);
ColourImage rasterise(const VectorDrawing& drawing, double dots_per_inch);

}  // namespace softscope
