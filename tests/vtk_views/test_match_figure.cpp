// tests/vtk_views/test_match_figure.cpp: matches lie where they were found, outliers on top.
#include <gmock/gmock.h>

#include "core/error.h"
#include "vtk_views/drawing_parts.h"
#include "vtk_views/plots/match_figure.h"

namespace softscope {
namespace {

/// 40 x 30 pixels; 300 matches five pixels to the right, every tenth an outlier.
MatchFigure manyMatches() {
  MatchFigure figure;
  figure.left = figure.right = ColourImage(40, 30, Rgb8{90, 40, 40});
  figure.left_title = "model view";
  figure.right_title = "left picture";
  figure.panels.resize(2);
  figure.panels[0].caption = "dense";
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2f place(float(i % 30), float(i / 10));
    figure.panels[0].matches.push_back({place, place + Eigen::Vector2f(5, 0), i % 10 != 0});
  }
  figure.panels[1].caption = "nothing was found";
  figure.note = "A note that is longer than a column of a journal is wide, and so needs two lines.";
  return figure;
}

TEST(MatchFigure, EveryMatchIsADotInBothPictures) {
  const VectorDrawing drawing = drawMatches(manyMatches(), figureStyle("ieee"));
  const auto dots = partsOf<DrawnDots>(drawing);
  ASSERT_EQ(dots.size(), 2u) << "inliers, then outliers over them";
  EXPECT_EQ(dots[0].centres.size(), 2u * 270);
  EXPECT_EQ(dots[1].centres.size(), 2u * 30);
  const auto pictures = partsOf<DrawnPicture>(drawing);
  ASSERT_EQ(pictures.size(), 4u);
  const double scale = (pictures[0].bottom_right.x_pt - pictures[0].top_left.x_pt) / 40;
  // Match 1: (1, 0) in the left picture, (6, 0) in the right one; centres of pixels.
  EXPECT_NEAR(dots[0].centres[0].x_pt, 1.5 * scale, 1e-9);
  EXPECT_NEAR(dots[0].centres[0].y_pt, pictures[0].top_left.y_pt + 0.5 * scale, 1e-9);
  EXPECT_NEAR(dots[0].centres[1].x_pt, pictures[1].top_left.x_pt + 6.5 * scale, 1e-9);
}

TEST(MatchFigure, LinesAreFewAndInTrueProportion) {
  const VectorDrawing drawing = drawMatches(manyMatches(), figureStyle("ieee"), 100);
  int green = 0, red = 0;
  for (const DrawnLine& line : partsOf<DrawnLine>(drawing)) {
    if (line.width_pt > 1) continue;  // of the legend
    EXPECT_GE(line.width_pt, 0.5) << "thinner lines are lost in print";
    (line.colour.red > line.colour.green ? red : green) += 1;
  }
  EXPECT_EQ(green + red, 100);
  EXPECT_EQ(red, 10);
}

TEST(MatchFigure, NothingLiesBeyondTheSheet) {
  for (const char* style : {"ieee", "nature", "slides"}) {
    const VectorDrawing drawing = drawMatches(manyMatches(), figureStyle(style));
    for (const DrawnText& text : partsOf<DrawnText>(drawing)) {
      EXPECT_LE(text.at.y_pt, drawing.height_pt);
      if (text.anchor == TextAnchor::kStart) {
        EXPECT_LE(text.at.x_pt + textWidthPt(text), drawing.width_pt + 0.5) << text.text;
      }
    }
    for (const DrawnPicture& picture : partsOf<DrawnPicture>(drawing))
      EXPECT_LE(picture.bottom_right.x_pt, drawing.width_pt + 1e-6);
  }
}

TEST(MatchFigure, PicturesOfTwoSizesAreRefused) {
  MatchFigure figure = manyMatches();
  figure.right = ColourImage(20, 30);
  EXPECT_THROW(drawMatches(figure, figureStyle("ieee")), Error);
  figure.right = figure.left;
  figure.panels.clear();
  EXPECT_THROW(drawMatches(figure, figureStyle("ieee")), Error);
}

}  // namespace
}  // namespace softscope
