// vtk_views/report/report_html.cpp: substitution into the templates in vtk_views/report.
#include "vtk_views/report/report_html.h"

#include <map>

#include "core/error.h"
#include "vtk_views/drawing/cairo_picture.h"
#include "vtk_views/drawing/html_text.h"

namespace softscope {

namespace embedded {
extern const char* const report_page_html;
extern const char* const report_viewer_html;
extern const char* const report_review_html;
extern const char* const report_style_css;
extern const char* const report_error_map_gl_js;
extern const char* const report_viewer_js;
extern const char* const report_review_js;
}  // namespace embedded

namespace {

constexpr double kDotsPerInch = 140;

/// Replaces each {{name}} in one pass: inserted text is not substituted again.
std::string filled(const std::string& frame, const std::map<std::string, std::string>& values) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t open; (open = frame.find("{{", at)) != std::string::npos;) {
    const std::size_t close = frame.find("}}", open);
    if (close == std::string::npos) break;
    const auto value = values.find(frame.substr(open + 2, close - open - 2));
    if (value == values.end()) throw Error("report: a frame names a part that is not there");
    out.append(frame, at, open - at);
    out += value->second;
    at = close + 2;
  }
  return out.append(frame, at, std::string::npos);
}

std::string element(const std::string& name, const std::string& text,
                    const std::string& type = "") {
  return "<" + name + (type.empty() ? "" : " class=\"" + type + "\"") + ">" + htmlEscaped(text) +
         "</" + name + ">";
}

/// Inline form: without prolog and namespace, which HTML does not need.
std::string inlineSvg(const VectorDrawing& drawing, const std::string& caption) {
  std::string svg = validUtf8(svgBytes(drawing));
  svg.erase(0, svg.find("<svg"));
  const std::string space = " xmlns=\"http://www.w3.org/2000/svg\"";
  if (const auto at = svg.find(space); at != std::string::npos) svg.erase(at, space.size());
  return svg.insert(4, " role=\"img\" aria-label=\"" + htmlEscaped(caption) + "\"");
}

std::string imageOf(const std::string& png, const std::string& text) {
  return "<img alt=\"" + htmlEscaped(text) + "\" src=\"data:image/png;base64," + base64(png) +
         "\">";
}

/// HTML of each kind of part.
struct PartWriter {
  const ReportPage& page;

  std::string operator()(const ReportParagraph& p) const {
    return element("p", p.text, p.important ? "important" : "") + "\n";
  }
  std::string operator()(const ReportList& list) const {
    std::string html = "<ul>\n";
    for (const std::string& item : list.items) html += element("li", item) + "\n";
    return html + "</ul>\n";
  }
  std::string operator()(const ReportTable& table) const {
    std::string html =
        std::string("<div class=\"scroll\"><table") + (table.words ? " class=\"words\">" : ">");
    if (!table.caption.empty()) html += element("caption", table.caption);
    if (!table.headings.empty()) html += "<thead>" + row(table.headings, "th") + "</thead>";
    html += "<tbody>\n";
    for (const auto& cells : table.rows) html += row(cells, "td");
    return html + "</tbody></table></div>\n";
  }
  std::string operator()(const ReportTiles& tiles) const {
    std::string html = "<div class=\"tiles\">\n";
    for (const ReportTile& tile : tiles.tiles) {
      const char* mark = tile.mark == ReportMark::kGood  ? " good"
                         : tile.mark == ReportMark::kBad ? " bad"
                                                         : "";
      html += std::string("<div class=\"tile") + mark + "\">" +
              element("div", tile.label, "label") + element("div", tile.value, "value") +
              element("div", tile.note, "note") + "</div>\n";
    }
    return html + "</div>\n";
  }
  std::string operator()(const ReportFigures& figures) const {
    std::string html = "<div class=\"figures\">\n";
    for (const auto& [drawing, caption] : figures.figures)
      html +=
          "<figure>" + inlineSvg(drawing, caption) + element("figcaption", caption) + "</figure>\n";
    return html + "</div>\n";
  }
  std::string operator()(const ReportPicture& picture) const {
    return "<figure class=\"picture\">" + imageOf(picture.png, picture.caption) +
           element("figcaption", picture.caption) + "</figure>\n";
  }
  std::string operator()(const ReportMapPlace& place) const {
    const std::string picture =
        !page.map_figure
            ? element("p", "No picture: nothing on the machine that made this page could draw one.")
            : imageOf(pngBytes(rasterise(*page.map_figure, kDotsPerInch)), place.paper_caption);
    return filled(embedded::report_viewer_html,
                  {{"picture", picture}, {"caption", htmlEscaped(place.caption)}});
  }
  std::string operator()(const ReportReview& review) const {
    return filled(embedded::report_review_html, {{"count", std::to_string(review.cases.size())}});
  }

  static std::string row(const std::vector<std::string>& cells, const std::string& kind) {
    std::string html = "<tr>";
    for (const std::string& cell : cells) html += element(kind, cell);
    return html + "</tr>\n";
  }
};

std::string sectionsOf(const ReportPage& page) {
  std::string html;
  for (const ReportSection& section : page.sections) {
    html +=
        "<section id=\"" + htmlEscaped(section.id) + "\">\n" + element("h2", section.title) + "\n";
    for (const ReportPart& part : section.parts) html += std::visit(PartWriter{page}, part);
    html += "</section>\n";
  }
  return html;
}

std::string contentsOf(const ReportPage& page) {
  std::string html;
  for (const ReportSection& section : page.sections)
    html += "<a href=\"#" + htmlEscaped(section.id) + "\">" + htmlEscaped(section.title) + "</a>\n";
  return html;
}

std::string dataElement(const std::string& id, const std::string& json) {
  return "<script type=\"application/json\" id=\"" + id + "\">" + scriptSafe(json) + "</script>\n";
}

/// Names of the reviewed cases as JSON; empty if none.
std::string reviewedCases(const ReportPage& page) {
  std::string json;
  for (const ReportSection& section : page.sections)
    for (const ReportPart& part : section.parts)
      if (const auto* review = std::get_if<ReportReview>(&part))
        for (const std::string& name : review->cases)
          json += (json.empty() ? "[" : ",") + jsonQuoted(name);
  return json.empty() ? json : json + "]";
}

std::string dataOf(const ReportPage& page) {
  std::string html = dataElement("metrics", page.metrics_json);
  if (!page.maps.empty()) html += dataElement("maps", reportMapsJson(page.maps, page.limit_mm));
  if (const std::string cases = reviewedCases(page); !cases.empty())
    html += dataElement("cases", cases);
  return html;
}

}  // namespace

std::string reportHtml(const ReportPage& page) {
  return filled(embedded::report_page_html,
                {{"title", htmlEscaped(page.title)},
                 {"subtitle", htmlEscaped(page.subtitle)},
                 {"notice", htmlEscaped(page.notice)},
                 {"style", embedded::report_style_css},
                 {"contents", contentsOf(page)},
                 {"sections", sectionsOf(page)},
                 {"data", dataOf(page)},
                 {"script", std::string(embedded::report_error_map_gl_js) +
                                embedded::report_viewer_js + embedded::report_review_js}});
}

}  // namespace softscope
