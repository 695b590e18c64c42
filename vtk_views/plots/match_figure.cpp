// vtk_views/plots/match_figure.cpp: images, dots, lines and texts, in drawing order.
#include "vtk_views/plots/match_figure.h"

#include <algorithm>

#include "core/error.h"
#include "vtk_views/drawing/paper_sheet.h"
#include "vtk_views/plots/plot_axes.h"

namespace softscope {
namespace {

constexpr Rgb8 kInlier{0, 158, 115}, kOutlier{230, 60, 20}, kNoteInk{90, 90, 90};  // Okabe and Ito
constexpr double kGapPt = 1.5 * kPtPerMm, kLinePt = 0.6, kDotPt = 1.3;

class MatchSheet {
 public:
  MatchSheet(const MatchFigure& figure, const FigureStyle& style, int lines);
  VectorDrawing draw();

 private:
  PointPt place(const Eigen::Vector2f& pixel, bool right) const;
  void drawRow(const MatchPanel& panel, char letter);
  void drawDots(const MatchPanel& panel, bool inliers);
  void drawLines(const MatchPanel& panel, bool inliers);
  void text(PointPt at, const std::string& words, double size_pt, TextAnchor anchor, Rgb8 colour);

  const MatchFigure& figure_;
  double font_pt_, picture_pt_, scale_;  // width of an image; pt per pixel
  std::size_t lines_;
  double top_pt_ = 0;  // top of the current row
  VectorDrawing drawing_;
};

MatchSheet::MatchSheet(const MatchFigure& figure, const FigureStyle& style, int lines)
    : figure_(figure),
      font_pt_(style.font_pt),
      picture_pt_((style.width_mm * kPtPerMm - kGapPt) / 2),
      scale_(picture_pt_ / figure.left.width_px),
      lines_(static_cast<std::size_t>(std::max(lines, 1))) {
  drawing_.width_pt = style.width_mm * kPtPerMm;
}

PointPt MatchSheet::place(const Eigen::Vector2f& pixel, bool right) const {
  return {(right ? picture_pt_ + kGapPt : 0) + (pixel.x() + 0.5) * scale_,
          top_pt_ + (pixel.y() + 0.5) * scale_};
}

void MatchSheet::text(PointPt at, const std::string& words, double size_pt, TextAnchor anchor,
                      Rgb8 colour) {
  DrawnText text;
  text.at = at;
  text.text = words;
  text.size_pt = size_pt;
  text.anchor = anchor;
  text.colour = colour;
  drawing_.parts.emplace_back(std::move(text));
}

void MatchSheet::drawDots(const MatchPanel& panel, bool inliers) {
  DrawnDots dots;
  dots.diameter_pt = kDotPt;
  dots.colour = inliers ? kInlier : kOutlier;
  for (const DrawnMatch& match : panel.matches) {
    if (match.inlier != inliers) continue;
    dots.centres.push_back(place(match.left_px, false));
    dots.centres.push_back(place(match.right_px, true));
  }
  if (!dots.centres.empty()) drawing_.parts.emplace_back(std::move(dots));
}

void MatchSheet::drawLines(const MatchPanel& panel, bool inliers) {
  const std::size_t step = 1 + (panel.matches.size() - 1) / lines_;
  for (std::size_t i = step / 2; i < panel.matches.size(); i += step) {
    const DrawnMatch& match = panel.matches[i];
    if (match.inlier == inliers)
      drawing_.parts.emplace_back(
          DrawnLine{{place(match.left_px, false), place(match.right_px, true)},
                    kLinePt,
                    inliers ? kInlier : kOutlier});
  }
}

void MatchSheet::drawRow(const MatchPanel& panel, char letter) {
  const double height_pt = figure_.left.height_px * scale_;
  for (const bool right : {false, true}) {
    const double x_pt = right ? picture_pt_ + kGapPt : 0;
    drawing_.parts.emplace_back(DrawnPicture{{x_pt, top_pt_},
                                             {x_pt + picture_pt_, top_pt_ + height_pt},
                                             right ? figure_.right : figure_.left});
  }
  for (const bool inliers : {true, false}) {
    drawDots(panel, inliers);
    if (!panel.matches.empty()) drawLines(panel, inliers);
  }
  top_pt_ += height_pt + 1.3 * font_pt_;
  text({0, top_pt_}, std::string("(") + letter + ") " + panel.caption, font_pt_, TextAnchor::kStart,
       {});
  top_pt_ += 0.7 * font_pt_;
}

VectorDrawing MatchSheet::draw() {
  top_pt_ = 1.4 * font_pt_;
  text({picture_pt_ / 2, 0.9 * font_pt_}, figure_.left_title, font_pt_, TextAnchor::kMiddle, {});
  text({1.5 * picture_pt_ + kGapPt, 0.9 * font_pt_}, figure_.right_title, font_pt_,
       TextAnchor::kMiddle, {});
  char letter = 'a';
  for (const MatchPanel& panel : figure_.panels) drawRow(panel, letter++);
  drawLegend({{"inlier of the rigid pose", kInlier}, {"outlier", kOutlier}},
             {0, top_pt_ + 0.6 * font_pt_}, font_pt_, drawing_);
  top_pt_ += 1.5 * font_pt_;
  for (const std::string& line :
       brokenLines(figure_.note, drawing_.width_pt, 0.9 * font_pt_, /*bold=*/false)) {
    top_pt_ += 1.2 * font_pt_;
    text({0, top_pt_}, line, 0.9 * font_pt_, TextAnchor::kStart, kNoteInk);
  }
  drawing_.height_pt = top_pt_ + 0.4 * font_pt_;
  return std::move(drawing_);
}

}  // namespace

VectorDrawing drawMatches(const MatchFigure& figure, const FigureStyle& style, int lines) {
  if (figure.panels.empty() || figure.left.width_px == 0 ||
      figure.left.width_px != figure.right.width_px ||
      figure.left.height_px != figure.right.height_px)
    throw Error("matches: they need two images of one size");
  return MatchSheet(figure, style, lines).draw();
}

}  // namespace softscope
