// tests/vtk_views/test_series_plot.cpp: figures of errors: what is drawn where, in every format.
#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "vtk_views/drawing/fonts.h"
#include "vtk_views/drawing_parts.h"
#include "vtk_views/plots/plot_axes.h"
#include "vtk_views/plots/series_plot.h"
#include "vtk_views/plots/value_series_plot.h"
#include "vtk_views/plots/worst_frames_plot.h"

namespace softscope {
namespace {

using testing::HasSubstr;
using testing::Not;

ErrorSeriesData rising() {
  ErrorSeriesData data;
  data.title = "a < b & \"c\"";
  for (int i = 0; i <= 10; ++i) {
    data.times.push_back(0.1 * i);
    data.median.push_back(0.1 + 0.01 * i);
    data.mean.push_back(0.2 + 0.01 * i);
    data.p95.push_back(0.5);
  }
  return data;
}

ErrorHistogramData twoBins() {
  ErrorHistogramData data;
  data.title = "two bins";
  data.high = 2;
  data.shares = {0.6, 0.3};
  data.cumulative = {0.6, 0.9};
  data.share_beyond = 0.1;
  data.median = 0.8;
  data.p95 = 1.9;
  return data;
}

std::vector<std::string> wordsOf(const VectorDrawing& drawing) {
  std::vector<std::string> words;
  for (const DrawnText& text : partsOf<DrawnText>(drawing)) words.push_back(text.text);
  return words;
}

TEST(SeriesPlot, CurvesRiseWithTheirValuesAndStayInTheirOrder) {
  const VectorDrawing drawing = drawErrorSeries(rising());
  std::vector<DrawnLine> curves;
  for (const DrawnLine& line : partsOf<DrawnLine>(drawing))
    if (line.points.size() == 11) curves.push_back(line);
  ASSERT_EQ(curves.size(), 3u) << "P95, median, mean";
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_LT(curves[0].points[i].y_pt, curves[2].points[i].y_pt) << "P95 above the mean";
    EXPECT_LT(curves[2].points[i].y_pt, curves[1].points[i].y_pt) << "the mean above the median";
  }
  EXPECT_LT(curves[2].points[10].y_pt, curves[2].points[0].y_pt) << "up is more";
  EXPECT_LT(curves[2].points[0].x_pt, curves[2].points[10].x_pt) << "right is later";
  // Equal steps of time and error are equal steps on the page.
  const auto& p = curves[2].points;
  EXPECT_NEAR(p[10].y_pt - p[5].y_pt, p[5].y_pt - p[0].y_pt, 1e-9);
}

TEST(SeriesPlot, EveryPartLiesOnThePage) {
  const auto inside = [](const VectorDrawing& drawing, const PointPt& p) {
    return p.x_pt >= 0 && p.y_pt >= 0 && p.x_pt <= drawing.width_pt && p.y_pt <= drawing.height_pt;
  };
  ErrorSeriesData wild = rising();
  wild.title = "";
  for (const VectorDrawing& drawing : {drawErrorSeries(wild), drawErrorHistogram(twoBins())}) {
    for (const auto& line : partsOf<DrawnLine>(drawing))
      for (const auto& p : line.points) EXPECT_TRUE(inside(drawing, p));
    for (const DrawnText& text : partsOf<DrawnText>(drawing)) {
      const double width = textWidthPt(text), before = width * static_cast<int>(text.anchor) / 2;
      const PointPt begin = text.upwards ? PointPt{text.at.x_pt, text.at.y_pt + before}
                                         : PointPt{text.at.x_pt - before, text.at.y_pt};
      const PointPt end = text.upwards ? PointPt{begin.x_pt, begin.y_pt - width}
                                       : PointPt{begin.x_pt + width, begin.y_pt};
      EXPECT_TRUE(inside(drawing, begin) && inside(drawing, end)) << text.text;
    }
  }
}

TEST(SeriesPlot, ALongTitleLosesItsMiddle) {
  ErrorHistogramData data = twoBins();
  data.title = "\xC3\xA4model.ply against " + std::string(150, 'm') + "_CT_cut\xC3\xA4.stl";
  const VectorDrawing drawing = drawErrorHistogram(data);
  for (const DrawnText& text : partsOf<DrawnText>(drawing)) {
    if (!text.bold) continue;
    EXPECT_LE(text.at.x_pt + textWidthPt(text), drawing.width_pt);
    EXPECT_THAT(text.text, testing::StartsWith("\xC3\xA4model.p"));
    EXPECT_THAT(text.text, HasSubstr("\xE2\x80\xA6"));
    EXPECT_THAT(text.text, testing::EndsWith("cut\xC3\xA4.stl"));
  }
}

TEST(SeriesPlot, NumbersBelowAnAxisDoNotTouch) {
  for (const double width : {0.2, 0.21, 0.16, 1000.5, 31.0}) {
    const PlotAxes axes({0, 0}, {120, 50}, {0.06, 0.06 + width}, {0, 1}, 8);
    VectorDrawing drawing = newPlotSheet(60, 40);
    axes.drawFrame("", "", drawing);
    double last_end = -1e9;
    int numbers = 0;
    for (const DrawnText& text : partsOf<DrawnText>(drawing)) {
      if (text.anchor != TextAnchor::kMiddle || text.text.empty()) continue;
      const double half = textWidthPt(text) / 2;
      EXPECT_GT(text.at.x_pt - half, last_end) << text.text;
      last_end = text.at.x_pt + half;
      ++numbers;
    }
    EXPECT_GE(numbers, 1) << width;
  }
}

TEST(SeriesPlot, NamesAxesWithTheirUnits) {
  EXPECT_THAT(wordsOf(drawErrorSeries(rising())),
              testing::IsSupersetOf({"time [s]", "distance to the surface [mm]", "mean", "median",
                                     "up to P95", "0.0", "0.5"}));
  EXPECT_THAT(wordsOf(drawErrorHistogram(twoBins())),
              testing::IsSupersetOf({"median 0.80 mm", "P95 1.90 mm", "points below [%]",
                                     "10 % beyond \xE2\x86\x92"}));
}

TEST(SeriesPlot, AGapInTheSeriesIsAGapInTheFigure) {
  ErrorSeriesData data = rising();
  data.mean[5] = data.p95[5] = std::nan("");
  std::vector<std::size_t> lengths;
  for (const DrawnLine& line : partsOf<DrawnLine>(drawErrorSeries(data)))
    if (line.width_pt == 1.2 && line.points.size() > 2 && !line.dashed)
      lengths.push_back(line.points.size());
  EXPECT_EQ(lengths, (std::vector<std::size_t>{5, 5}));
}

TEST(SeriesPlot, OneModelIsStillSeen) {
  ErrorSeriesData data;
  data.times = {3};
  data.mean = {0.2};
  data.median = {0.1};
  data.p95 = {0.4};
  EXPECT_NO_THROW(svgBytes(drawErrorSeries(data)));
}

TEST(SeriesPlot, BarsHaveTheHeightOfTheirShares) {
  std::vector<double> heights, widths;
  for (const DrawnShape& bar : partsOf<DrawnShape>(drawErrorHistogram(twoBins()))) {
    heights.push_back(bar.points[0].y_pt - bar.points[1].y_pt);
    widths.push_back(bar.points[2].x_pt - bar.points[1].x_pt);
  }
  ASSERT_GE(heights.size(), 2u);
  EXPECT_NEAR(heights[0], 2 * heights[1], 1e-9);
  EXPECT_NEAR(widths[0], widths[1], 1e-9);
}

TEST(SeriesPlot, WorstFramesHaveBarsOfTheirErrorsOverTheirNumbers) {
  WorstFramesData data;
  data.frames = {35, 7};
  data.mean = {0.4, 0.2};
  data.p95 = {1.0, 0.5};
  const VectorDrawing drawing = drawWorstFrames(data);
  std::vector<double> heights;
  for (const DrawnShape& bar : partsOf<DrawnShape>(drawing))
    heights.push_back(bar.points[0].y_pt - bar.points[1].y_pt);
  ASSERT_GE(heights.size(), 4u);
  EXPECT_NEAR(heights[0] / heights[1], 2.5, 1e-9) << "P95 behind the mean";
  EXPECT_NEAR(heights[0] / heights[2], 2, 1e-9);
  EXPECT_THAT(wordsOf(drawing), testing::IsSupersetOf({"35", "7", "frame, worst mean first"}));
  data.p95.pop_back();
  EXPECT_THROW(drawWorstFrames(data), Error);
  EXPECT_THROW(drawWorstFrames({}), Error);
}

TEST(SeriesPlot, AValueOverTimeSpansItsAxis) {
  const ValueSeriesData data{"time [s]", "PSNR [dB]", {0, 1, 2}, {30, std::nan(""), 32}};
  const VectorDrawing drawing = drawValueSeries(data);
  const auto dots = partsOf<DrawnDots>(drawing);
  ASSERT_EQ(dots.size(), 1u);
  ASSERT_EQ(dots[0].centres.size(), 2u) << "NaN is no dot";
  EXPECT_GT(dots[0].centres[0].y_pt - dots[0].centres[1].y_pt, 0.8 * 29 * kPtPerMm)
      << "not squeezed into the upper end of an axis from 0";
  EXPECT_THROW(drawValueSeries({"", "", {1}, {}}), Error);
  EXPECT_THROW(drawValueSeries({"", "", {1}, {std::nan("")}}), Error);
}

TEST(SeriesPlot, NothingToDrawIsRefused) {
  EXPECT_THROW(drawErrorSeries({}), Error);
  ErrorSeriesData unequal = rising();
  unequal.p95.pop_back();
  EXPECT_THROW(drawErrorSeries(unequal), Error);
  EXPECT_THROW(drawErrorHistogram({}), Error);
}

TEST(VectorDrawings, SvgKeepsTextAsTextAndEscapesIt) {
  const std::string svg = svgBytes(drawErrorSeries(rising()));
  EXPECT_THAT(svg, HasSubstr(">a &lt; b &amp; &quot;c&quot;</text>"));
  EXPECT_THAT(svg, HasSubstr(">distance to the surface [mm]</text>"));
  EXPECT_THAT(svg, HasSubstr("<polyline"));
  EXPECT_THAT(svg, Not(HasSubstr("<image"))) << "vectors alone";
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
}

TEST(VectorDrawings, PdfCarriesItsFontAndNoTimeOfDay) {
  if (findFont(figureFont()).path.empty()) GTEST_SKIP() << "no fonts on this machine";
  const std::string pdf = pdfBytes(drawErrorSeries(rising()));
  EXPECT_THAT(pdf, testing::StartsWith("%PDF-1."));
  EXPECT_THAT(pdf, HasSubstr("/FontFile2"));
  EXPECT_THAT(pdf, HasSubstr("20000101"));
  EXPECT_THAT(pdf, Not(HasSubstr("/Subtype /Image")));
  EXPECT_EQ(pdf, pdfBytes(drawErrorSeries(rising())));
}

TEST(VectorDrawings, PixelsHaveTheColourOfWhatLiesThere) {
  VectorDrawing drawing;
  drawing.width_pt = 72;
  drawing.height_pt = 36;
  drawing.parts.emplace_back(DrawnShape{{{36, 0}, {72, 0}, {72, 36}, {36, 36}}, {10, 200, 30}});
  const ColourImage picture = rasterise(drawing, 100);
  EXPECT_EQ(picture.width_px, 100);
  EXPECT_EQ(picture.height_px, 50);
  EXPECT_EQ(picture.at(25, 25), (Rgb8{255, 255, 255}));
  EXPECT_EQ(picture.at(75, 25), (Rgb8{10, 200, 30}));
}

TEST(VectorDrawings, WithoutASizeAreRefused) {
  EXPECT_THROW(svgBytes({}), Error);
  EXPECT_THROW(pdfBytes({}), Error);
  EXPECT_THROW(rasterise({}, 100), Error);
  VectorDrawing drawing;
  drawing.width_pt = drawing.height_pt = 10;
  EXPECT_THROW(rasterise(drawing, 0), Error);
}

TEST(PlotAxesRange, OneValueStillHasARange) {
  const AxisRange range = AxisRange::around(3, 3);
  EXPECT_LT(range.low, 3);
  EXPECT_GT(range.high, 3);
}

}  // namespace
}  // namespace softscope
