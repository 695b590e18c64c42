// vtk_views/drawing/canvas.cpp: drawing with cairo.
#include "vtk_views/drawing/canvas.h"

#include <cmath>

#include "vtk_views/drawing/cairo_picture.h"
#include "vtk_views/drawing/fonts.h"

namespace softscope {
struct Canvas::Cairo {
  CairoSurface surface;
  CairoContext context;

  void setColour(Rgb8 colour) {
    cairo_set_source_rgb(context.get(), colour.red / 255.0, colour.green / 255.0,
                         colour.blue / 255.0);
  }
  void setFont(const TextStyle& style) {
    cairo_select_font_face(context.get(), figureFont().c_str(), CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context.get(), style.size_px);
  }
};

Canvas::Canvas(int width_px, int height_px) : cairo_(std::make_unique<Cairo>()) {
  cairo_->surface = newCairoPixels(width_px, height_px);
  cairo_->context.reset(cairo_create(cairo_->surface.get()));
  cairo_->setColour({255, 255, 255});
  cairo_paint(cairo_->context.get());
}

Canvas::~Canvas() = default;

void Canvas::fill(const Box& box, Rgb8 colour) {
  cairo_->setColour(colour);
  cairo_rectangle(cairo_->context.get(), box.x_px, box.y_px, box.width_px, box.height_px);
  cairo_fill(cairo_->context.get());
}

void Canvas::frame(const Box& box, Rgb8 colour) {
  cairo_->setColour(colour);
  cairo_set_line_width(cairo_->context.get(), 1);
  cairo_rectangle(cairo_->context.get(), box.x_px - 0.5, box.y_px - 0.5, box.width_px + 1,
                  box.height_px + 1);
  cairo_stroke(cairo_->context.get());
}

void Canvas::line(double x0_px, double y0_px, double x1_px, double y1_px, double width_px,
                  Rgb8 colour) {
  cairo_->setColour(colour);
  cairo_set_line_width(cairo_->context.get(), width_px);
  cairo_move_to(cairo_->context.get(), x0_px, y0_px);
  cairo_line_to(cairo_->context.get(), x1_px, y1_px);
  cairo_stroke(cairo_->context.get());
}

void Canvas::triangle(double x0, double y0, double x1, double y1, double x2, double y2,
                      Rgb8 colour) {
  cairo_->setColour(colour);
  cairo_move_to(cairo_->context.get(), x0, y0);
  cairo_line_to(cairo_->context.get(), x1, y1);
  cairo_line_to(cairo_->context.get(), x2, y2);
  cairo_close_path(cairo_->context.get());
  cairo_fill(cairo_->context.get());
}

void Canvas::picture(const ColourImage& picture, const Box& box, bool smooth) {
  if (picture.empty()) return;
  const CairoSurface source = toCairo(picture);
  cairo_t* context = cairo_->context.get();
  cairo_save(context);
  cairo_rectangle(context, box.x_px, box.y_px, box.width_px, box.height_px);
  cairo_clip(context);
  cairo_translate(context, box.x_px, box.y_px);
  cairo_scale(context, double(box.width_px) / picture.width_px,
              double(box.height_px) / picture.height_px);
  cairo_set_source_surface(context, source.get(), 0, 0);
  cairo_pattern_set_extend(cairo_get_source(context), CAIRO_EXTEND_PAD);  // avoids a pale border
  cairo_pattern_set_filter(cairo_get_source(context),
                           smooth ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  cairo_paint(context);
  cairo_restore(context);
}

void Canvas::text(double x_px, double y_px, const std::string& text, const TextStyle& style) {
  const double width_px = textWidth(text, style);
  const double shift_px =
      style.align == Align::kLeft ? 0 : (style.align == Align::kCentre ? width_px / 2 : width_px);
  cairo_t* context = cairo_->context.get();
  cairo_save(context);
  cairo_->setColour(style.colour);
  cairo_translate(context, x_px, y_px);
  if (style.upwards) cairo_rotate(context, -M_PI / 2);
  cairo_move_to(context, -shift_px, 0);
  cairo_show_text(context, text.c_str());
  cairo_restore(context);
}

double Canvas::textWidth(const std::string& text, const TextStyle& style) const {
  cairo_->setFont(style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_->context.get(), text.c_str(), &extents);
  return extents.x_advance;
}

ColourImage Canvas::pixels() const { return fromCairo(cairo_->surface.get()); }

}  // namespace softscope
