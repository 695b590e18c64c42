// vtk_views/plots/depth_picture.cpp: two panels, colour bar, legend.
#include "vtk_views/plots/depth_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/median.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/drawing/nice_ticks.h"

namespace softscope {
namespace {

constexpr int kLeastPanelPx = 400, kLargestPanelPx = 900;  // height; text is too small below

double positionIn(const DepthRange& range, double depth_mm) {
  return (depth_mm - range.nearest_mm) / (range.farthest_mm - range.nearest_mm);
}

struct ColouredDepth {
  ColourImage picture;
  bool any_unmeasured = false, any_masked = false, any_nearer = false, any_farther = false;
};

ColouredDepth colourDepth(const Raster<float>& depth_mm, const Mask& mask,
                          const DepthRange& range) {
  ColouredDepth coloured;
  coloured.picture = ColourImage(depth_mm.width_px, depth_mm.height_px);
  for (std::size_t i = 0; i < depth_mm.size(); ++i) {
    const float z_mm = depth_mm.values[i];
    Rgb8& pixel = coloured.picture.values[i];
    if (!mask.empty() && mask.values[i] != 0) {
      pixel = kMaskedGrey;
      coloured.any_masked = true;
    } else if (std::isnan(z_mm)) {
      pixel = kUnmeasuredGrey;
      coloured.any_unmeasured = true;
    } else {
      pixel = viridis(positionIn(range, z_mm));
      coloured.any_nearer |= z_mm < range.nearest_mm;
      coloured.any_farther |= z_mm > range.farthest_mm;
    }
  }
  return coloured;
}

void drawTicks(Canvas& canvas, const DepthPictureLayout& layout, const DepthRange& range) {
  const Box& bar = layout.bar;
  const Ticks ticks = niceTicks(range.nearest_mm, range.farthest_mm, 6);
  TextStyle style;
  style.size_px = layout.font_px;
  double widest_px = 0;
  for (const double value : ticks.values) {
    const double y = bar.bottom_px() - positionIn(range, value) * bar.height_px;
    canvas.line(bar.right_px() + 1, y, bar.right_px() + 0.4 * layout.font_px, y, 1, {60, 60, 60});
    canvas.text(bar.right_px() + 0.65 * layout.font_px, y + 0.36 * layout.font_px,
                ticks.label(value), style);
    widest_px = std::max(widest_px, canvas.textWidth(ticks.label(value), style));
  }
  style.align = Align::kCentre;
  style.upwards = true;
  canvas.text(bar.right_px() + widest_px + 2.1 * layout.font_px, bar.y_px + bar.height_px / 2.0,
              "depth [mm]", style);
}

void drawBar(Canvas& canvas, const DepthPictureLayout& layout, const DepthRange& range,
             const ColouredDepth& coloured) {
  const Box& bar = layout.bar;
  for (int y = 0; y < bar.height_px; ++y) {
    const double position = 1 - (y + 0.5) / bar.height_px;
    canvas.fill({bar.x_px, bar.y_px + y, bar.width_px, 1}, viridis(position));
  }
  canvas.frame(bar);
  const double middle = bar.x_px + bar.width_px / 2.0, tip = 0.7 * layout.font_px;
  if (coloured.any_farther)
    canvas.triangle(bar.x_px, bar.y_px - 2, bar.right_px(), bar.y_px - 2, middle,
                    bar.y_px - 2 - tip, viridis(1));
  if (coloured.any_nearer)
    canvas.triangle(bar.x_px, bar.bottom_px() + 2, bar.right_px(), bar.bottom_px() + 2, middle,
                    bar.bottom_px() + 2 + tip, viridis(0));
  drawTicks(canvas, layout, range);
}

/// Grey patch with its meaning, right-aligned at x; returns the right end of the next entry.
double drawLegendEntry(Canvas& canvas, const DepthPictureLayout& layout, double right_px,
                       double baseline_px, Rgb8 grey, const std::string& meaning) {
  TextStyle style;
  style.size_px = 0.9 * layout.font_px;
  style.align = Align::kRight;
  canvas.text(right_px, baseline_px, meaning, style);
  const int side = layout.font_px;
  const Box patch{int(right_px - canvas.textWidth(meaning, style)) - side - layout.font_px / 2,
                  int(baseline_px) - side + 2, side, side};
  canvas.fill(patch, grey);
  canvas.frame(patch);
  return patch.x_px - layout.font_px;
}

void drawCaptions(Canvas& canvas, const DepthPictureLayout& layout, const DepthPictureText& text,
                  const ColouredDepth& coloured) {
  const double baseline_px = layout.depth.bottom_px() + 1.5 * layout.font_px;
  TextStyle style;
  style.size_px = layout.font_px;
  canvas.text(layout.photograph.x_px, baseline_px, "(a) left camera", style);
  canvas.text(layout.depth.x_px, baseline_px, "(b) depth", style);
  double right_px = layout.depth.right_px();
  if (coloured.any_unmeasured)
    right_px =
        drawLegendEntry(canvas, layout, right_px, baseline_px, kUnmeasuredGrey, "not measured");
  if (coloured.any_masked)
    drawLegendEntry(canvas, layout, right_px, baseline_px, kMaskedGrey, "masked");
  style.colour = {90, 90, 90};
  style.size_px = 0.9 * layout.font_px;
  canvas.text(layout.photograph.x_px, baseline_px + 1.7 * layout.font_px, text.note, style);
  style = {};
  style.bold = true;
  style.size_px = 1.1 * layout.font_px;
  canvas.text(layout.photograph.x_px, layout.photograph.y_px - 0.8 * layout.font_px, text.title,
              style);
}

}  // namespace

DepthRange depthRangeToShow(const Raster<float>& depth_mm) {
  std::vector<float> measured_mm;
  for (const float z_mm : depth_mm.values)
    if (std::isfinite(z_mm)) measured_mm.push_back(z_mm);
  if (measured_mm.empty()) return {0, 100};
  const double low_mm = quantileOf(measured_mm, 0.01), high_mm = quantileOf(measured_mm, 0.99);
  const double span_mm = std::max(1.0, high_mm - low_mm);
  const double step_mm = std::pow(10.0, std::floor(std::log10(span_mm / 2)));  // 0.1, 1, 10 mm …
  return {step_mm * std::floor((low_mm - 0.02 * span_mm) / step_mm),
          step_mm * std::ceil((high_mm + 0.02 * span_mm) / step_mm)};
}

DepthPictureLayout layoutDepthPicture(int picture_width_px, int picture_height_px) {
  DepthPictureLayout layout;
  const int height = std::clamp(picture_height_px, kLeastPanelPx, kLargestPanelPx);
  const int width = int(std::lround(double(height) * picture_width_px / picture_height_px));
  const int font = std::max(13, height / 32);
  layout.font_px = font;
  layout.photograph = {2 * font, 3 * font, width, height};
  layout.depth = {layout.photograph.right_px() + font, 3 * font, width, height};
  layout.bar = {layout.depth.right_px() + font, 3 * font, int(1.4 * font), height};
  layout.width_px = layout.bar.right_px() + int(6.5 * font);
  layout.height_px = layout.depth.bottom_px() + 4 * font;
  return layout;
}

ColourImage drawDepthPicture(const ColourImage& left, const Raster<float>& depth_mm,
                             const Mask& mask, const DepthRange& range,
                             const DepthPictureText& text) {
  if (left.empty() || !left.sameShape(depth_mm) || (!mask.empty() && !left.sameShape(mask)))
    throw Error("depth image: photograph, depth and mask must have one shape");
  const DepthPictureLayout layout = layoutDepthPicture(left.width_px, left.height_px);
  const ColouredDepth coloured = colourDepth(depth_mm, mask, range);
  Canvas canvas(layout.width_px, layout.height_px);
  canvas.picture(left, layout.photograph, /*smooth=*/true);
  canvas.frame(layout.photograph);
  canvas.picture(coloured.picture, layout.depth, /*smooth=*/false);
  canvas.frame(layout.depth);
  drawBar(canvas, layout, range, coloured);
  drawCaptions(canvas, layout, text, coloured);
  return canvas.pixels();
}

}  // namespace softscope
