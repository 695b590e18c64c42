// vtk_views/drawing/paper_sheet.h: text, tables and drawings, one below the other, on as many pages
// as needed.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

struct SheetText {
  double size_pt = 9;
  bool bold = false;
  double indent_pt = 0;
  double after_pt = 4;  // left free below
  Rgb8 colour{20, 20, 20};
};

/// A4, upright. Whatever doesn't fit goes to the next page.
class PaperSheet {
 public:
  static constexpr double kWidthPt = 595.28, kHeightPt = 841.89;
  static constexpr double kSidePt = 42, kTopPt = 52, kBottomPt = 46;
  static constexpr double kTextWidthPt = kWidthPt - 2 * kSidePt;

  PaperSheet() { newPage(); }

  void newPage();
  /// A new page unless `height_pt` is left on this one.
  void ensure(double height_pt);
  void skip(double height_pt) { y_pt_ += height_pt; }

  /// Breaks at blanks; words too long for a line are cut.
  void text(const std::string& words, const SheetText& style);
  /// `top_left` of the drawing; its own white is not drawn.
  void put(const VectorDrawing& drawing, PointPt top_left);
  void rule(Rgb8 colour, double width_pt);

  double y() const { return y_pt_; }
  VectorDrawing& page() { return pages_.back(); }
  /// With `notice` at the top and numbers at the bottom of each.
  std::vector<VectorDrawing> finished(const std::string& notice) const;

 private:
  std::vector<VectorDrawing> pages_;
  double y_pt_ = 0;
};

/// Parted by blanks; bytes that are no UTF-8 replaced.
std::vector<std::string> wordsOfText(const std::string& text);

/// Lines no wider than `width_pt`.
std::vector<std::string> brokenLines(const std::string& words, double width_pt, double size_pt,
                                     bool bold);

}  // namespace softscope
