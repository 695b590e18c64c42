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

// All texts are plain UTF-8; the writers escape them.

struct ReportParagraph {
  std::string text;
  bool important = false;
};

struct ReportList {
  std::vector<std::string> items;
};

/// Numbers are right-aligned; the first, left-aligned column names the row.
struct ReportTable {
  std::string caption;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  // each as long as the headings
  bool words = false;                          // all columns are texts
};

enum class ReportMark { kNone, kGood, kBad };

/// Main number in large type.
struct ReportTile {
  std::string label, value, note;
  ReportMark mark = ReportMark::kNone;
};
struct ReportTiles {
  std::vector<ReportTile> tiles;
};

/// Plots side by side if there is space.
struct ReportFigures {
  std::vector<std::pair<VectorDrawing, std::string>> figures;  // with captions
};

struct ReportPicture {
  std::string png;  // bytes of the file
  std::string caption;
};

/// Position of the map in the page; its image in PDF.
struct ReportMapPlace {
  std::string caption, paper_caption;
};

/// Controls to step through the cases, grade them and save the result; empty in PDF.
struct ReportReview {
  std::vector<std::string> cases;
};

using ReportPart = std::variant<ReportParagraph, ReportList, ReportTable, ReportTiles,
                                ReportFigures, ReportPicture, ReportMapPlace, ReportReview>;

struct ReportSection {
  std::string id;  // letters only
  std::string title;
  std::vector<ReportPart> parts;
};

struct ReportPage {
  std::string title, subtitle, notice;  // the notice is on every PDF page
  std::vector<ReportSection> sections;
  std::vector<ReportMap> maps;              // empty: no map
  double limit_mm = 1;                      // of the map colours, common to all
  std::optional<VectorDrawing> map_figure;  // rendered maps, if a renderer is available
  std::string metrics_json;
};

}  // namespace softscope
