// vtk_views/drawing/paper_sheet.h: layout
// of text, tables and drawings on pages.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

struct SheetText {
  double size_pt = 9;
  bool bold = false;
  double indent_pt = 0;
  double after_pt = 4;  // space below
  Rgb8 colour{20, 20, 20};
};

/// A4, portrait. Content that does not fit begins on the next page.
class PaperSheet {
 public:
  static constexpr double kWidthPt = 595.28, kHeightPt = 841.89;
  static constexpr double kSidePt = 42, kTopPt = 52, kBottomPt = 46;
  static constexpr double kTextWidthPt = kWidthPt - 2 * kSidePt;

  PaperSheet() { newPage(); }

  void newPage();
  /// Begins a new page unless `height_pt` is free on this one.
  void ensure(double height_pt);
  void skip(double height_pt) { y_pt_ += height_pt; }

  /// Breaks lines at blanks; splits words longer than a line.
  void text(const std::string& words, const SheetText& style);
  /// Places a drawing with its `top_left`, without its white background.
  void put(const VectorDrawing& drawing, PointPt top_left);
  void rule(Rgb8 colour, double width_pt);

  double y() const { return y_pt_; }
  VectorDrawing& page() { return pages_.back(); }
  /// Pages with `notice` at the top and page numbers at the bottom.
  std::vector<VectorDrawing> finished(const std::string& notice) const;

 private:
  std::vector<VectorDrawing> pages_;
  double y_pt_ = 0;
};

/// Words separated by blanks; invalid UTF-8 is replaced.
std::vector<std::string> wordsOfText(const std::string& text);

/// Lines of at most `width_pt`.
std::vector<std::string> brokenLines(const std::string& words, double width_pt, double size_pt,
                                     bool bold);

}  // namespace softscope
