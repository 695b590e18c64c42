// vtk_views/drawing/canvas.h: raster drawing surface.
#pragma once

#include <memory>
#include <string>

#include "core/image.h"

namespace softscope {

/// Pixels of a figure; (0, 0) is the outer corner of the top-left pixel, x right, y down.
struct Box {
  int x_px = 0, y_px = 0, width_px = 0, height_px = 0;

  int right_px() const { return x_px + width_px; }
  int bottom_px() const { return y_px + height_px; }
};

enum class Align { kLeft, kCentre, kRight };

struct TextStyle {
  double size_px = 14;
  Align align = Align::kLeft;
  bool bold = false;
  bool upwards = false;  // rotated, from bottom to top
  Rgb8 colour{20, 20, 20};
};

/// Drawing with cairo: smooth lines and text, exact fills of whole pixels.
class Canvas {
 public:
  Canvas(int width_px, int height_px);
  ~Canvas();

  void fill(const Box& box, Rgb8 colour);
  /// Line of one pixel around the outside of the box.
  void frame(const Box& box, Rgb8 colour = {60, 60, 60});
  void line(double x0_px, double y0_px, double x1_px, double y1_px, double width_px, Rgb8 colour);
  void triangle(double x0, double y0, double x1, double y1, double x2, double y2, Rgb8 colour);
  /// Scales the image to the box; `smooth` interpolates (photographs), else pixels stay sharp.
  void picture(const ColourImage& picture, const Box& box, bool smooth);
  /// (x, y): left end, middle or right end of the baseline.
  void text(double x_px, double y_px, const std::string& text, const TextStyle& style);

  double textWidth(const std::string& text, const TextStyle& style) const;
  ColourImage pixels() const;

 private:
  struct Cairo;
  std::unique_ptr<Cairo> cairo_;
};

}  // namespace softscope
