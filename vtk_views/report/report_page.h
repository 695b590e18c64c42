// vtk_views/report/report_page.h: content of a report, for HTML and PDF.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/report/report_maps.h"

namespace softscope {

// All texts are UTF-8 and plain: whoever writes the page escapes them.

struct ReportParagraph {
  std::string text;
  bool important = false;
};

struct ReportList {
  std::vector<std::string> items;
};

/// Numbers stand on the right; the first column, on the left, names the row.
struct ReportTable {
  std::string caption;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  // each as long as the headings
  bool words = false;                          // all columns hold words, none numbers
};

enum class ReportMark { kNone, kGood, kBad };

/// A headline number in large type.
struct ReportTile {
  std::string label, value, note;
  ReportMark mark = ReportMark::kNone;
};
struct ReportTiles {
  std::vector<ReportTile> tiles;
};

/// Plots side by side where there is room.
struct ReportFigures {
  std::vector<std::pair<VectorDrawing, std::string>> figures;  // with captions
};

struct ReportPicture {
  std::string png;  // the file's bytes
  std::string caption;
};

/// Where the page's map stands; on paper its image.
struct ReportMapPlace {
  std::string caption, paper_caption;
};

/// Keys to go through the cases, to grade them and to save what was found; on paper nothing.
struct ReportReview {
  std::vector<std::string> cases;
};

using ReportPart = std::variant<ReportParagraph, ReportList, ReportTable, ReportTiles,
                                ReportFigures, ReportPicture, ReportMapPlace, ReportReview>;

struct ReportSection {
  std::string id;  // letters alone
  std::string title;
  std::vector<ReportPart> parts;
};

struct ReportPage {
  std::string title, subtitle, notice;  // the notice stands on every page of paper
  std::vector<ReportSection> sections;
  std::vector<ReportMap> maps;              // empty: no map
  double limit_mm = 1;                      // of the maps' colours, the same for all
  std::optional<VectorDrawing> map_figure;  // of the maps, where something could draw it
  std::string metrics_json;
};

}  // namespace softscope
