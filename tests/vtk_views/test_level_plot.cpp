// tests/vtk_views/test_level_plot.cpp: contents of plots of studies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "vtk_views/plots/level_plot.h"

namespace softscope {
namespace {

using testing::HasSubstr;
using testing::Not;

LevelPlotData twoCurves() {
  return {"Noise",
          "noise [%]",
          "error [mm]",
          {{"stereo", {1, 2, 3}, {0.1, 0.2, NAN}, {0.3, 0.4, NAN}},
           {"depth", {1, 2, 3}, {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}}},
          0.5};
}

int countOf(const VectorDrawing& drawing, Rgb8 colour) {
  int count = 0;
  for (const auto& part : drawing.parts)
    if (const auto* shape = std::get_if<DrawnShape>(&part)) count += shape->colour == colour;
  return count;
}

TEST(LevelPlot, NamesCurvesAxesAndWhatIsMissing) {
  const std::string svg = svgBytes(drawLevels(twoCurves()));
  for (const char* text : {"stereo", "depth", "noise [%]", "error [mm]", "no result", "limit"})
    EXPECT_THAT(svg, HasSubstr(text));
}

TEST(LevelPlot, DrawsADotForEachResultAlone) {
  const VectorDrawing drawing = drawLevels(twoCurves());
  EXPECT_EQ(countOf(drawing, {0, 114, 178}), 2) << "the third level has no result";
  EXPECT_EQ(countOf(drawing, {213, 94, 0}), 3);
}

TEST(LevelPlot, SaysNothingOfMissingResultsWhereAllAreThere) {
  LevelPlotData data = twoCurves();
  data.curves.erase(data.curves.begin());
  EXPECT_THAT(svgBytes(drawLevels(data)), Not(HasSubstr("no result")));
}

TEST(LevelPlot, RefusesCurvesThatDoNotFit) {
  EXPECT_THROW(drawLevels({}), Error);
  LevelPlotData data = twoCurves();
  data.curves[0].p95.pop_back();
  EXPECT_THROW(drawLevels(data), Error);
}

TEST(CaseBars, NamesEveryCaseAndThePublishedValues) {
  CaseBarsData data{"Organs", "error [mm]", "published", {{"heart", 0.1, 0.3, 0.46}}};
  data.bars.push_back({"kidney", 0.2, NAN, NAN});
  const VectorDrawing drawing = drawCaseBars(data);
  const std::string svg = svgBytes(drawing);
  for (const char* text : {"heart", "kidney", "published"}) EXPECT_THAT(svg, HasSubstr(text));
  // A diamond and the legend's sample; only one case was published.
  EXPECT_EQ(countOf(drawing, {213, 94, 0}), 2);
  EXPECT_THROW(drawCaseBars({}), Error);
}

}  // namespace
}  // namespace softscope
