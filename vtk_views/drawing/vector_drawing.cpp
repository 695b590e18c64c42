// vtk_views/drawing/vector_drawing.cpp: own SVG writer, because
// cairo's SVG contains no text; PDF and pixels by cairo.
#include "vtk_views/drawing/vector_drawing.h"

#include <cairo/cairo-pdf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "vtk_views/drawing/cairo_picture.h"
#include "vtk_views/drawing/fonts.h"
#include "vtk_views/drawing/html_text.h"

namespace softscope {
namespace {

constexpr double kDashOnPt = 3, kDashOffPt = 1.5;
constexpr double kRimShare = 0.22;  // share of the font size; half of it is below the letters

void requireSize(const VectorDrawing& drawing) {
  if (!(drawing.width_pt > 0 && drawing.height_pt > 0 && drawing.width_pt < 1e5 &&
        drawing.height_pt < 1e5))
    throw Error("figure: its size must be above 0 and below 35 m");
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  std::string digits = text;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits == "-0" ? "0" : digits;
}

std::string hex(Rgb8 colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  return out;
}

std::string pathOf(const std::vector<PointPt>& points) {
  std::string path;
  for (const PointPt& p : points)
    path += (path.empty() ? "" : " ") + number(p.x_pt) + "," + number(p.y_pt);
  return path;
}

/// Writes one element per part.
struct SvgWriter {
  std::string text;

  void operator()(const DrawnLine& line) {
    text += "<polyline points=\"" + pathOf(line.points) + "\" fill=\"none\" stroke=\"" +
            hex(line.colour) + "\" stroke-width=\"" + number(line.width_pt) +
            "\" stroke-linejoin=\"round\"";
    if (line.dashed)
      text += " stroke-dasharray=\"" + number(kDashOnPt) + " " + number(kDashOffPt) + "\"";
    text += "/>\n";
  }
  void operator()(const DrawnShape& shape) {
    text +=
        "<polygon points=\"" + pathOf(shape.points) + "\" fill=\"" + hex(shape.colour) + "\"/>\n";
  }
  void operator()(const DrawnText& t) {
    const char* anchors[] = {"start", "middle", "end"};
    text += "<text x=\"" + number(t.at.x_pt) + "\" y=\"" + number(t.at.y_pt) + "\" font-size=\"" +
            number(t.size_pt) + "\" fill=\"" + hex(t.colour) + "\" text-anchor=\"" +
            anchors[static_cast<int>(t.anchor)] + "\"";
    if (t.bold) text += " font-weight=\"bold\"";
    if (t.rim)
      text += " stroke=\"" + hex(*t.rim) + "\" stroke-width=\"" + number(kRimShare * t.size_pt) +
              "\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
    if (t.upwards)
      text += " transform=\"rotate(-90 " + number(t.at.x_pt) + " " + number(t.at.y_pt) + ")\"";
    text += ">" + escaped(validUtf8(t.text)) + "</text>\n";
  }
  /// Lines of zero length with round ends are the shortest form.
  void operator()(const DrawnDots& dots) {
    text += "<path d=\"";
    for (const PointPt& p : dots.centres)
      text += "M" + number(p.x_pt) + "," + number(p.y_pt) + "h0";
    text += "\" fill=\"none\" stroke=\"" + hex(dots.colour) + "\" stroke-width=\"" +
            number(dots.diameter_pt) + "\" stroke-linecap=\"round\"/>\n";
  }
  void operator()(const DrawnPicture& p) {
    text += "<image x=\"" + number(p.top_left.x_pt) + "\" y=\"" + number(p.top_left.y_pt) +
            "\" width=\"" + number(p.bottom_right.x_pt - p.top_left.x_pt) + "\" height=\"" +
            number(p.bottom_right.y_pt - p.top_left.y_pt) +
            "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
            base64(pngBytes(p.picture)) + "\"/>\n";
  }
};

struct MoveDown {
  double down_pt;

  void operator()(DrawnLine& line) const {
    for (PointPt& p : line.points) p.y_pt += down_pt;
  }
  void operator()(DrawnShape& shape) const {
    for (PointPt& p : shape.points) p.y_pt += down_pt;
  }
  void operator()(DrawnText& text) const { text.at.y_pt += down_pt; }
  void operator()(DrawnDots& dots) const {
    for (PointPt& p : dots.centres) p.y_pt += down_pt;
  }
  void operator()(DrawnPicture& picture) const {
    picture.top_left.y_pt += down_pt;
    picture.bottom_right.y_pt += down_pt;
  }
};

void setColour(cairo_t* context, Rgb8 colour) {
  cairo_set_source_rgb(context, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

void trace(cairo_t* context, const std::vector<PointPt>& points) {
  cairo_new_path(context);
  for (const PointPt& p : points) cairo_line_to(context, p.x_pt, p.y_pt);
}

double setFont(cairo_t* context, const DrawnText& text) {
  cairo_select_font_face(context, figureFont().c_str(), CAIRO_FONT_SLANT_NORMAL,
                         text.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, text.size_pt);
  cairo_text_extents_t extents;
  cairo_text_extents(context, validUtf8(text.text).c_str(), &extents);
  return extents.x_advance;
}

/// Draws each part; one pixel of the context is one point.
struct CairoPainter {
  cairo_t* context;

  void operator()(const DrawnLine& line) const {
    const double dashes[] = {kDashOnPt, kDashOffPt};
    setColour(context, line.colour);
    cairo_set_line_width(context, line.width_pt);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(context, dashes, line.dashed ? 2 : 0, 0);
    trace(context, line.points);
    cairo_stroke(context);
  }
  void operator()(const DrawnShape& shape) const {
    setColour(context, shape.colour);
    trace(context, shape.points);
    cairo_close_path(context);
    cairo_fill(context);
  }
  void operator()(const DrawnText& text) const {
    cairo_save(context);
    cairo_translate(context, text.at.x_pt, text.at.y_pt);
    if (text.upwards) cairo_rotate(context, -M_PI / 2);
    const double width_pt = setFont(context, text);
    const double x_pt = -width_pt * static_cast<int>(text.anchor) / 2;
    if (text.rim) drawRim(text, x_pt);
    setColour(context, text.colour);
    cairo_move_to(context, x_pt, 0);
    cairo_show_text(context, validUtf8(text.text).c_str());
    cairo_restore(context);
  }
  void drawRim(const DrawnText& text, double x_pt) const {
    setColour(context, *text.rim);
    cairo_new_path(context);
    cairo_move_to(context, x_pt, 0);
    cairo_text_path(context, validUtf8(text.text).c_str());
    cairo_set_dash(context, nullptr, 0, 0);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(context, kRimShare * text.size_pt);
    cairo_stroke(context);
  }
  void operator()(const DrawnDots& dots) const {
    cairo_save(context);
    setColour(context, dots.colour);
    cairo_set_dash(context, nullptr, 0, 0);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(context, dots.diameter_pt);
    cairo_new_path(context);
    for (const PointPt& p : dots.centres) {
      cairo_move_to(context, p.x_pt, p.y_pt);
      cairo_line_to(context, p.x_pt, p.y_pt);
    }
    cairo_stroke(context);
    cairo_restore(context);
  }
  void operator()(const DrawnPicture& p) const {
    if (p.picture.empty()) return;
    const double width_pt = p.bottom_right.x_pt - p.top_left.x_pt;
    const double height_pt = p.bottom_right.y_pt - p.top_left.y_pt;
    const CairoSurface source = toCairo(p.picture);
    cairo_save(context);
    cairo_rectangle(context, p.top_left.x_pt, p.top_left.y_pt, width_pt, height_pt);
    cairo_clip(context);
    cairo_translate(context, p.top_left.x_pt, p.top_left.y_pt);
    cairo_scale(context, width_pt / p.picture.width_px, height_pt / p.picture.height_px);
    cairo_set_source_surface(context, source.get(), 0, 0);
    cairo_pattern_set_extend(cairo_get_source(context), CAIRO_EXTEND_PAD);  // avoids a pale border
    cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_GOOD);
    cairo_paint(context);
    cairo_restore(context);
  }
};

void paint(const VectorDrawing& drawing, cairo_surface_t* surface, double scale) {
  const CairoContext context(cairo_create(surface));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);  // widths scale linearly
  cairo_set_font_options(context.get(), options);
  cairo_font_options_destroy(options);
  cairo_scale(context.get(), scale, scale);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  for (const auto& part : drawing.parts) std::visit(CairoPainter{context.get()}, part);
  requireGoodCairo(cairo_status(context.get()));
}

cairo_status_t appendTo(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void appendBelow(const VectorDrawing& below, double gap_pt, VectorDrawing& drawing) {
  const double down_pt = drawing.height_pt + gap_pt;
  for (auto part : below.parts) {
    std::visit(MoveDown{down_pt}, part);
    drawing.parts.push_back(std::move(part));
  }
  drawing.height_pt = down_pt + below.height_pt;
  drawing.width_pt = std::max(drawing.width_pt, below.width_pt);
}

double textWidthPt(const DrawnText& text) {
  const CairoSurface surface = newCairoPixels(1, 1);
  const CairoContext context(cairo_create(surface.get()));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context.get(), options);
  cairo_font_options_destroy(options);
  return setFont(context.get(), text);
}

std::string svgBytes(const VectorDrawing& drawing) {
  requireSize(drawing);
  const std::string width = number(drawing.width_pt), height = number(drawing.height_pt);
  SvgWriter writer;
  writer.text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "width=\"" +
      width + "pt\" height=\"" + height + "pt\" viewBox=\"0 0 " + width + " " + height +
      "\" font-family=\"" + figureFont() + ", Arial, Helvetica, sans-serif\">\n" +
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (const auto& part : drawing.parts) std::visit(writer, part);
  return writer.text + "</svg>\n";
}

std::string pdfBytes(const VectorDrawing& drawing) { return pdfOfPages({drawing}); }

std::string pdfOfPages(const std::vector<VectorDrawing>& pages) {
  if (pages.empty()) throw Error("figure: a PDF needs a page");
  std::string bytes;
  const CairoSurface surface(
      cairo_pdf_surface_create_for_stream(appendTo, &bytes, pages[0].width_pt, pages[0].height_pt));
  // A creation time would make the file differ on each run.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");
  for (const VectorDrawing& page : pages) {
    requireSize(page);
    cairo_pdf_surface_set_size(surface.get(), page.width_pt, page.height_pt);
    paint(page, surface.get(), 1);
    cairo_surface_show_page(surface.get());
  }
  cairo_surface_finish(surface.get());
  requireGoodCairo(cairo_surface_status(surface.get()));
  return bytes;
}

ColourImage rasterise(const VectorDrawing& drawing, double dots_per_inch) {
  requireSize(drawing);
  const double scale = dots_per_inch / 72;
  if (!(scale > 0)) throw Error("figure: the resolution must be above 0 dots an inch");
  const int width_px = static_cast<int>(std::lround(drawing.width_pt * scale));
  const int height_px = static_cast<int>(std::lround(drawing.height_pt * scale));
  const CairoSurface surface = newCairoPixels(width_px, height_px);
  paint(drawing, surface.get(), scale);
  return fromCairo(surface.get());
}

}  // namespace softscope
