// vtk_views/scenes/panel_grid.cpp: sizes derived from width and font size.
#include "vtk_views/scenes/panel_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kGapMm = 1.5, kLeastPanelMm = 10;
constexpr double kFourInARowMm = 140;                       // four panels are too small below
constexpr double kCaption = 1.7, kRow = 1.7, kSpace = 0.4;  // in units of the font size
constexpr double kNote = 0.9, kNoteRow = 1.4;

double entryWidthPt(const LegendEntry& entry, double font_pt) {
  DrawnText text;
  text.text = entry.meaning;
  text.size_pt = font_pt;
  return textWidthPt(text) + 3.5 * font_pt;
}

/// Rows of entries that fit the width.
std::vector<std::vector<LegendEntry>> rowsOf(const std::vector<LegendEntry>& entries,
                                             double width_pt, double font_pt) {
  std::vector<std::vector<LegendEntry>> rows;
  double used_pt = 0;
  for (const LegendEntry& entry : entries) {
    const double needed_pt = entryWidthPt(entry, font_pt);
    if (rows.empty() || used_pt + needed_pt > width_pt) {
      rows.emplace_back();
      used_pt = 0;
    }
    rows.back().push_back(entry);
    used_pt += needed_pt;
  }
  return rows;
}

double footHeightPt(const FigureFoot& foot, double width_pt, double font_pt) {
  double height_pt = double(rowsOf(foot.legend, width_pt, font_pt).size()) * kRow * font_pt;
  if (foot.colours) height_pt += colourBarHeightPt(font_pt) + kSpace * font_pt;
  return height_pt + double(foot.notes.size()) * kNoteRow * font_pt;
}

void drawNote(const std::string& line, PointPt at, double width_pt, double font_pt,
              VectorDrawing& drawing) {
  DrawnText note;
  note.at = at;
  note.text = line;
  note.size_pt = kNote * font_pt;
  note.colour = {90, 90, 90};
  const double needed_pt = textWidthPt(note);
  if (needed_pt > width_pt) note.size_pt *= width_pt / needed_pt;
  drawing.parts.emplace_back(std::move(note));
}

int columnsFor(std::size_t count, int wanted, double width_mm) {
  const int most = static_cast<int>(count);
  if (wanted > 0) return std::min(wanted, most);
  const int fit = std::min(most, width_mm >= kFourInARowMm ? 4 : 2);
  const int rows = (most + fit - 1) / fit;
  return (most + rows - 1) / rows;  // six as two rows of three, not four and two
}

}  // namespace

std::vector<LegendEntry> legendOf(const Scene& scene) {
  std::vector<LegendEntry> entries;
  for (const SceneSurface& surface : scene.surfaces) {
    if (surface.name.empty()) continue;
    entries.push_back({surface.name, scene.volume ? surface.colour : onWhite(surface.colour)});
    entries.back().dotted = surface.isPoints();
  }
  return entries;
}

PanelGrid layOutPanels(std::size_t count, int columns, const FigureStyle& style,
                       const FigureFoot& foot) {
  const int across = columnsFor(count, columns, style.width_mm);
  const double gap_pt = kGapMm * kPtPerMm;
  const double row_gap_pt = kCaption * style.font_pt + 0.5 * gap_pt;
  PanelGrid grid;
  grid.width_pt = style.width_mm * kPtPerMm;
  const double side_pt = (grid.width_pt - (across - 1) * gap_pt) / across;
  require(side_pt >= kLeastPanelMm * kPtPerMm, "`columns=`", across,
          "panels must be 10 mm wide or more; give fewer columns or a wider figure");
  for (int i = 0; i < static_cast<int>(count); ++i)
    grid.panels.push_back(
        {{(i % across) * (side_pt + gap_pt), (i / across) * (side_pt + row_gap_pt)},
         side_pt,
         side_pt});
  grid.foot_pt = grid.panels.back().bottom() + row_gap_pt;
  grid.height_pt = grid.foot_pt + footHeightPt(foot, grid.width_pt, style.font_pt);
  return grid;
}

VectorDrawing newSheet(const PanelGrid& grid) {
  VectorDrawing drawing;
  drawing.width_pt = grid.width_pt;
  drawing.height_pt = grid.height_pt;
  return drawing;
}

void drawCaption(std::size_t index, const std::string& text, const PanelPlace& place,
                 const FigureStyle& style, VectorDrawing& drawing) {
  std::string letters(1, char('a' + index % 26));  // (aa) after (z)
  if (index >= 26) letters.insert(letters.begin(), char('a' + index / 26 - 1));
  DrawnText caption;
  caption.at = {place.top_left.x_pt, place.bottom() + 1.2 * style.font_pt};
  caption.text = "(" + letters + ") " + text;
  caption.size_pt = style.font_pt;
  const double width_pt = textWidthPt(caption);
  if (width_pt > place.width_pt) caption.size_pt *= place.width_pt / width_pt;
  drawing.parts.emplace_back(std::move(caption));
}

void drawFoot(const FigureFoot& foot, const PanelGrid& grid, const FigureStyle& style,
              VectorDrawing& drawing) {
  const double font_pt = style.font_pt;
  double y_pt = grid.foot_pt;
  for (const auto& row : rowsOf(foot.legend, grid.width_pt, font_pt)) {
    drawLegend(row, {0, y_pt + 0.5 * kRow * font_pt}, font_pt, drawing);
    y_pt += kRow * font_pt;
  }
  if (foot.colours) {
    y_pt += kSpace * font_pt;
    y_pt += drawColourBar(*foot.colours, foot.bar, {0, y_pt}, grid.width_pt, font_pt, drawing);
  }
  for (const std::string& line : foot.notes) {
    y_pt += kNoteRow * font_pt;
    drawNote(line, {0, y_pt - 0.3 * font_pt}, grid.width_pt, font_pt, drawing);
  }
}

}  // namespace softscope
