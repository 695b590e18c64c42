// vtk_views/report/report_pdf.cpp: layout of each kind of part on pages.
#include "vtk_views/report/report_pdf.h"

#include <algorithm>
#include <numeric>

#include "vtk_views/drawing/cairo_picture.h"
#include "vtk_views/drawing/html_text.h"
#include "vtk_views/drawing/paper_sheet.h"

namespace softscope {
namespace {

constexpr double kTextPt = 9, kTablePt = 7.6, kRowPt = 11.5, kCellGapPt = 9;
constexpr double kTogetherPt = 250;  // smaller tables are not split
constexpr Rgb8 kPageInk{20, 20, 20}, kPageGrey{95, 95, 95}, kPagePale{222, 222, 222},
    kBlue{0, 81, 127}, kBad{161, 18, 18}, kSoft{244, 245, 247};

DrawnText textAt(PointPt at, const std::string& words, double size_pt) {
  DrawnText text;
  text.at = at;
  text.text = words;
  text.size_pt = size_pt;
  return text;
}

/// Table with columns of the width of their longest cell, reduced if the page is too narrow.
class TableSetter {
 public:
  TableSetter(const ReportTable& table, PaperSheet& sheet) : table_(table), sheet_(sheet) {
    measure();
  }

  void set() {
    const double all_pt = (kRowPt + 1) * static_cast<double>(table_.rows.size() + 2) + 8;
    if (all_pt < kTogetherPt) sheet_.ensure(all_pt);
    if (!table_.caption.empty())
      sheet_.text(table_.caption, {kTextPt, /*bold=*/true, 0, 1, kPageInk});
    if (!table_.headings.empty()) setRow(table_.headings, /*heading=*/true);
    for (const auto& row : table_.rows) setRow(row, false);
    sheet_.skip(8);
  }

 private:
  void measure() {
    std::vector<const std::vector<std::string>*> rows;
    if (!table_.headings.empty()) rows.push_back(&table_.headings);
    for (const auto& row : table_.rows) rows.push_back(&row);
    for (const auto* row : rows)
      for (std::size_t i = 0; i < row->size(); ++i) {
        widths_.resize(std::max(widths_.size(), row->size()), 0);
        DrawnText cell = textAt({}, validUtf8((*row)[i]), kTablePt);
        cell.bold = row == &table_.headings;
        widths_[i] = std::max(widths_[i], textWidthPt(cell) + kCellGapPt);
      }
    narrow(rows);
  }

  /// Widths limited to `most_pt`, unless a word is longer.
  std::vector<double> capped(double most_pt, const std::vector<double>& least_pt) const {
    std::vector<double> widths = widths_;
    for (std::size_t i = 0; i < widths.size(); ++i)
      widths[i] = std::max(std::min(widths[i], most_pt), least_pt[i]);
    return widths;
  }

  /// If all columns together are too wide, the widest are reduced, down to their longest word.
  void narrow(const std::vector<const std::vector<std::string>*>& rows) {
    const auto fits = [](const std::vector<double>& widths) {
      return std::accumulate(widths.begin(), widths.end(), 0.0) <= PaperSheet::kTextWidthPt;
    };
    if (fits(widths_)) return;
    std::vector<double> least_pt(widths_.size(), 24);
    for (const auto* row : rows)
      for (std::size_t i = 0; i < row->size(); ++i)
        for (const std::string& word : wordsOfText((*row)[i])) {
          DrawnText text = textAt({}, word, kTablePt);
          text.bold = row == &table_.headings;
          least_pt[i] = std::max(least_pt[i], textWidthPt(text) + kCellGapPt);
        }
    if (!fits(capped(0, least_pt)))  // words without blanks are split
      for (double& least : least_pt) least = std::min(least, 40.0);
    double low_pt = 0, high_pt = PaperSheet::kTextWidthPt;
    for (int i = 0; i < 40; ++i) {
      const double middle_pt = (low_pt + high_pt) / 2;
      (fits(capped(middle_pt, least_pt)) ? low_pt : high_pt) = middle_pt;
    }
    widths_ = capped(low_pt, least_pt);
  }

  void setRow(const std::vector<std::string>& cells, bool heading) {
    std::vector<std::vector<std::string>> lines;
    std::size_t most = 1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      lines.push_back(brokenLines(cells[i], widths_[i] - kCellGapPt + 0.5, kTablePt, heading));
      most = std::max(most, lines.back().size());
    }
    const double height_pt = kRowPt + 9.5 * static_cast<double>(most - 1);
    sheet_.ensure(height_pt + 1);
    double x_pt = PaperSheet::kSidePt;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool right = i > 0 && !table_.words;
      for (std::size_t k = 0; k < lines[i].size(); ++k) {
        DrawnText text = textAt({right ? x_pt + widths_[i] - kCellGapPt : x_pt,
                                 sheet_.y() + 8.3 + 9.5 * static_cast<double>(k)},
                                lines[i][k], kTablePt);
        text.anchor = right ? TextAnchor::kEnd : TextAnchor::kStart;
        text.bold = heading;
        if (cells[i] == "FAILED") text.colour = kBad;
        sheet_.page().parts.emplace_back(std::move(text));
      }
      x_pt += widths_[i];
    }
    sheet_.skip(height_pt);
    sheet_.page().parts.emplace_back(
        DrawnLine{{{PaperSheet::kSidePt, sheet_.y()}, {x_pt - kCellGapPt, sheet_.y()}},
                  heading ? 0.8 : 0.35,
                  heading ? kPageInk : kPagePale});
    sheet_.skip(1);
  }

  const ReportTable& table_;
  PaperSheet& sheet_;
  std::vector<double> widths_;
};

cairo_status_t readFrom(void* closure, unsigned char* data, unsigned int length) {
  auto& rest = *static_cast<std::string_view*>(closure);
  if (rest.size() < length) return CAIRO_STATUS_READ_ERROR;
  std::copy_n(rest.begin(), length, data);
  rest.remove_prefix(length);
  return CAIRO_STATUS_SUCCESS;
}

/// On white. Throws Error unless the bytes are a PNG.
ColourImage pictureFromPng(const std::string& png) {
  std::string_view rest = png;
  const CairoSurface read(cairo_image_surface_create_from_png_stream(readFrom, &rest));
  requireGoodCairo(cairo_surface_status(read.get()));
  const CairoSurface flat = newCairoPixels(cairo_image_surface_get_width(read.get()),
                                           cairo_image_surface_get_height(read.get()));
  const CairoContext context(cairo_create(flat.get()));
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  cairo_set_source_surface(context.get(), read.get(), 0, 0);
  cairo_paint(context.get());
  return fromCairo(flat.get());
}

/// Layout of each kind of part.
struct PartSetter {
  const ReportPage& page;
  PaperSheet& sheet;

  void operator()(const ReportParagraph& p) const {
    sheet.text(p.text, {p.important ? 11 : kTextPt, p.important, 0, 6, kPageInk});
  }
  void operator()(const ReportList& list) const {
    for (const std::string& item : list.items) {
      sheet.ensure(14);
      sheet.page().parts.emplace_back(
          textAt({PaperSheet::kSidePt, sheet.y() + kTextPt}, "\xE2\x80\xA2", kTextPt));
      sheet.text(item, {kTextPt, false, 11, 3, kPageInk});
    }
    sheet.skip(4);
  }
  void operator()(const ReportTable& table) const { TableSetter(table, sheet).set(); }
  void operator()(const ReportTiles& tiles) const {
    if (tiles.tiles.empty()) return;
    const double gap_pt = 7, height_pt = 46;
    const auto count = static_cast<double>(tiles.tiles.size());
    const double width_pt = (PaperSheet::kTextWidthPt - (count - 1) * gap_pt) / count;
    sheet.ensure(height_pt + 8);
    double x_pt = PaperSheet::kSidePt;
    for (const ReportTile& tile : tiles.tiles) {
      setTile(tile, {x_pt, sheet.y()}, width_pt, height_pt);
      x_pt += width_pt + gap_pt;
    }
    sheet.skip(height_pt + 8);
  }
  void operator()(const ReportFigures& figures) const {
    double x_pt = 0, row_pt = 0;
    for (const auto& [drawing, caption] : figures.figures) {
      if (x_pt > 0 && x_pt + drawing.width_pt > PaperSheet::kTextWidthPt + 1) {
        sheet.skip(row_pt);
        x_pt = row_pt = 0;
      }
      if (x_pt == 0) sheet.ensure(drawing.height_pt + 34);
      sheet.put(drawing, {PaperSheet::kSidePt + x_pt, sheet.y()});
      row_pt = std::max(row_pt, drawing.height_pt + setCaption(caption, x_pt, drawing));
      x_pt += drawing.width_pt + 6;
    }
    sheet.skip(row_pt + 6);
  }
  void operator()(const ReportPicture& picture) const {
    const ColourImage pixels = pictureFromPng(picture.png);
    double width_pt = PaperSheet::kTextWidthPt;
    double height_pt = width_pt * pixels.height_px / std::max(pixels.width_px, 1);
    const double scale = std::min(1.0, 600 / height_pt);
    width_pt *= scale;
    height_pt *= scale;
    sheet.ensure(height_pt + 20);
    const PointPt from{PaperSheet::kSidePt, sheet.y()};
    sheet.page().parts.emplace_back(
        DrawnPicture{from, {from.x_pt + width_pt, from.y_pt + height_pt}, pixels});
    sheet.skip(height_pt + 4);
    sheet.text(picture.caption, {8, false, 0, 8, kPageGrey});
  }
  void operator()(const ReportMapPlace& place) const {
    if (!page.map_figure) {
      sheet.text("No picture of the map: nothing on the machine that made this could draw one.",
                 {8, false, 0, 8, kPageGrey});
      return;
    }
    sheet.ensure(page.map_figure->height_pt + 24);
    sheet.put(*page.map_figure, {PaperSheet::kSidePt, sheet.y()});
    sheet.skip(page.map_figure->height_pt + 2);
    sheet.text(place.paper_caption, {8, false, 0, 8, kPageGrey});
  }
  void operator()(const ReportReview&) const {}  // controls do not apply to PDF

  void setTile(const ReportTile& tile, PointPt at, double width_pt, double height_pt) const {
    auto& parts = sheet.page().parts;
    const PointPt end{at.x_pt + width_pt, at.y_pt + height_pt};
    parts.emplace_back(DrawnShape{{at, {end.x_pt, at.y_pt}, end, {at.x_pt, end.y_pt}}, kSoft});
    parts.emplace_back(
        DrawnLine{{at, {end.x_pt, at.y_pt}}, 2, tile.mark == ReportMark::kBad ? kBad : kBlue});
    DrawnText label = textAt({at.x_pt + 6, at.y_pt + 12}, validUtf8(tile.label), 7.5);
    label.colour = kPageGrey;
    DrawnText value = textAt({at.x_pt + 6, at.y_pt + 27}, validUtf8(tile.value), 13);
    value.bold = true;
    if (tile.mark == ReportMark::kBad) value.colour = kBad;
    parts.emplace_back(label);
    parts.emplace_back(value);
    double y_pt = at.y_pt + 36;
    for (const std::string& line : brokenLines(tile.note, width_pt - 10, 6, false)) {
      DrawnText note = textAt({at.x_pt + 6, y_pt}, line, 6);
      note.colour = kPageGrey;
      parts.emplace_back(note);
      y_pt += 7;
    }
  }

  /// Below the drawing, with its width; returns the height.
  double setCaption(const std::string& caption, double x_pt, const VectorDrawing& drawing) const {
    double y_pt = sheet.y() + drawing.height_pt + 8;
    double height_pt = 2;
    for (const std::string& line : brokenLines(caption, drawing.width_pt - 6, 7.5, false)) {
      DrawnText text = textAt({PaperSheet::kSidePt + x_pt, y_pt}, line, 7.5);
      text.colour = kPageGrey;
      sheet.page().parts.emplace_back(text);
      y_pt += 10;
      height_pt += 10;
    }
    return height_pt;
  }
};

/// Height of the content that stays on the page of its section title.
double heightWithTitle(const ReportPage& page, const ReportSection& section) {
  if (section.parts.empty()) return 0;
  const ReportPart& first = section.parts.front();
  if (std::holds_alternative<ReportMapPlace>(first) && page.map_figure)
    return page.map_figure->height_pt + 60;
  if (const auto* figures = std::get_if<ReportFigures>(&first);
      figures != nullptr && !figures->figures.empty())
    return figures->figures.front().first.height_pt + 70;
  return 90;
}

bool isForPaper(const ReportSection& section) {
  return std::any_of(section.parts.begin(), section.parts.end(), [](const ReportPart& part) {
    return !std::holds_alternative<ReportReview>(part);
  });
}

}  // namespace

std::string reportPdf(const ReportPage& page) {
  PaperSheet sheet;
  sheet.text(page.title, {17, /*bold=*/true, 0, 0, kPageInk});
  sheet.text(page.subtitle, {10, false, 0, 6, kPageGrey});
  for (const ReportSection& section : page.sections) {
    if (!isForPaper(section)) continue;
    sheet.ensure(heightWithTitle(page, section));
    sheet.skip(6);
    sheet.text(section.title, {12, /*bold=*/true, 0, 1, kPageInk});
    sheet.rule(kBlue, 1.2);
    for (const ReportPart& part : section.parts) std::visit(PartSetter{page, sheet}, part);
  }
  return pdfOfPages(sheet.finished(page.notice));
}

}  // namespace softscope
