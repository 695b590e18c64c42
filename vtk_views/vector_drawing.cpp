// vtk_views/vector_drawing.cpp: SVG in our own words, for cairo's would have no text; PDF and
// pixels by cairo.
#include "vtk_views/vector_drawing.h"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"
#include "vtk_views/fonts.h"

namespace softscope {
namespace {

constexpr double kDashOnPt = 3, kDashOffPt = 1.5;

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Context = std::unique_ptr<cairo_t, Destroy>;

void requireGood(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("figure: ") + cairo_status_to_string(status));
}

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

/// Writes each part as one element.
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
    if (t.upwards)
      text += " transform=\"rotate(-90 " + number(t.at.x_pt) + " " + number(t.at.y_pt) + ")\"";
    text += ">" + escaped(t.text) + "</text>\n";
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
  cairo_select_font_face(context, kFontFamily, CAIRO_FONT_SLANT_NORMAL,
                         text.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, text.size_pt);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.text.c_str(), &extents);
  return extents.x_advance;
}

/// Draws each part; a pixel of the context is a point.
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
    setColour(context, text.colour);
    cairo_move_to(context, -width_pt * static_cast<int>(text.anchor) / 2, 0);
    cairo_show_text(context, text.text.c_str());
    cairo_restore(context);
  }
};

void paint(const VectorDrawing& drawing, cairo_surface_t* surface, double scale) {
  const Context context(cairo_create(surface));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);  // widths scale
  cairo_set_font_options(context.get(), options);
  cairo_font_options_destroy(options);
  cairo_scale(context.get(), scale, scale);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  for (const auto& part : drawing.parts) std::visit(CairoPainter{context.get()}, part);
  requireGood(cairo_status(context.get()));
}

Surface newPixels(int width_px, int height_px) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px));
  requireGood(cairo_surface_status(surface.get()));
  return surface;
}

cairo_status_t appendTo(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

double textWidthPt(const DrawnText& text) {
  const Surface surface = newPixels(1, 1);
  const Context context(cairo_create(surface.get()));
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
      "\" font-family=\"" + kFontFamily + ", sans-serif\">\n" +
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (const auto& part : drawing.parts) std::visit(writer, part);
  return writer.text + "</svg>\n";
}

std::string pdfBytes(const VectorDrawing& drawing) {
  requireSize(drawing);
  std::string bytes;
  const Surface surface(
      cairo_pdf_surface_create_for_stream(appendTo, &bytes, drawing.width_pt, drawing.height_pt));
  // The time of day would make every file another one.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");
  paint(drawing, surface.get(), 1);
  cairo_surface_finish(surface.get());
  requireGood(cairo_surface_status(surface.get()));
  return bytes;
}

ColourImage rasterise(const VectorDrawing& drawing, double dots_per_inch) {
  requireSize(drawing);
  const double scale = dots_per_inch / 72;
  if (!(scale > 0)) throw Error("figure: the resolution must be above 0 dots an inch");
  const int width_px = static_cast<int>(std::lround(drawing.width_pt * scale));
  const int height_px = static_cast<int>(std::lround(drawing.height_pt * scale));
  const Surface surface = newPixels(width_px, height_px);
  paint(drawing, surface.get(), scale);
  cairo_surface_flush(surface.get());
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  ColourImage picture(width_px, height_px);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u) {
      std::uint32_t word = 0;  // cairo's RGB24: blue in the lowest byte
      std::memcpy(&word, data + std::size_t(v) * std::size_t(stride) + std::size_t(u) * 4, 4);
      picture.at(u, v) = {std::uint8_t(word >> 16), std::uint8_t(word >> 8), std::uint8_t(word)};
    }
  return picture;
}

}  // namespace softscope
