// tests/vtk_views/test_report_pdf.cpp: a report on paper.
#include <gmock/gmock.h>

#include <numeric>

#include "core/error.h"
#include "vtk_views/drawing/cairo_picture.h"
#include "vtk_views/drawing/paper_sheet.h"
#include "vtk_views/plots/agreement_plot.h"
#include "vtk_views/report/report_pdf.h"
#include "vtk_views/scenes/error_map_figure.h"
#include "vtk_views/scenes/offscreen_window.h"

namespace softscope {
namespace {

using testing::HasSubstr;

std::size_t countOf(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

ReportPage pageOf(std::vector<ReportPart> parts) {
  ReportPage page;
  page.title = "Title";
  page.notice = "Research use only, not for diagnosis.";
  page.sections = {{"only", "Only", std::move(parts)}};
  return page;
}

/// Every word on the sheet, page by page.
std::vector<std::string> wordsOn(const std::vector<VectorDrawing>& pages) {
  std::vector<std::string> words;
  for (const VectorDrawing& page : pages) {
    words.emplace_back();
    for (const auto& part : page.parts)
      if (const auto* text = std::get_if<DrawnText>(&part)) words.back() += text->text + " ";
  }
  return words;
}

TEST(ReportPdf, AllKindsOfPartsGoOnPaper) {
  VectorDrawing drawing;
  drawing.width_pt = drawing.height_pt = 50;
  drawing.parts.emplace_back(DrawnLine{{{0, 0}, {50, 50}}});
  const std::string odd = "odd \xFF\x01 <b>";
  ReportPage page = pageOf(
      {ReportParagraph{odd}, ReportList{{odd}}, ReportTable{odd, {odd, "b"}, {{odd, "1"}}, false},
       ReportTiles{{{odd, odd, odd, ReportMark::kBad}}}, ReportFigures{{{drawing, odd}}},
       ReportPicture{pngBytes(ColourImage(8, 8, Rgb8{9, 9, 9})), odd}, ReportMapPlace{odd, odd},
       ReportReview{{odd}}});
  EXPECT_THAT(reportPdf(page), testing::StartsWith("%PDF"));
  EXPECT_EQ(reportPdf(page), reportPdf(page)) << "the same page gives the same bytes";
  page.map_figure = drawing;
  EXPECT_THAT(reportPdf(page), testing::StartsWith("%PDF"));
  page.sections[0].parts = {ReportPicture{"no PNG", ""}};
  EXPECT_THROW(reportPdf(page), Error);
}

TEST(ReportPdf, ALongReportHasPagesAndTheNoticeOnEach) {
  PaperSheet sheet;
  for (int i = 0; i < 200; ++i) sheet.text("line " + std::to_string(i), {});
  const auto words = wordsOn(sheet.finished("For research."));
  ASSERT_GE(words.size(), 3u);
  for (const std::string& page : words) EXPECT_THAT(page, HasSubstr("For research."));
  EXPECT_THAT(words.back(), HasSubstr("line 199"));
  for (const VectorDrawing& page : sheet.finished(""))
    for (const auto& part : page.parts)
      if (const auto* text = std::get_if<DrawnText>(&part)) {
        EXPECT_LT(text->at.y_pt, PaperSheet::kHeightPt - 20) << text->text;
      }
}

TEST(ReportPdf, LinesKeepToTheirWidthAndLoseNoLetter) {
  const std::string text = "a few words and " + std::string(300, 'x') + " \xC3\xA9nd";
  std::string joined;
  for (const std::string& line : brokenLines(text, 100, 9, false)) {
    DrawnText drawn;
    drawn.text = line;
    drawn.size_pt = 9;
    EXPECT_LE(textWidthPt(drawn), 100.01) << line;
    joined += line;
  }
  EXPECT_EQ(countOf("x", joined), 300u);
  EXPECT_THAT(joined, HasSubstr("\xC3\xA9nd"));
}

TEST(AgreementPlot, DrawsADotACaseAndNeedsOne) {
  AgreementData data;
  data.x = {1, 2, 3, std::nan("")};
  data.differences = {0.1, -0.2, 0.3, 1};
  data.bias = {0.07, std::nan(""), std::nan("")};
  data.low_limit = data.high_limit = {std::nan(""), std::nan(""), std::nan("")};
  const VectorDrawing drawing = drawAgreement(data);
  std::size_t dots = 0;
  for (const auto& part : drawing.parts)
    if (const auto* drawn = std::get_if<DrawnDots>(&part)) dots += drawn->centres.size();
  EXPECT_EQ(dots, 3u);
  data.x.assign(4, std::nan(""));
  EXPECT_THROW(drawAgreement(data), Error);
  data.x.pop_back();
  EXPECT_THROW(drawAgreement(data), Error);
}

/// A square of points at error `error_mm`, before a larger grey square.
ErrorMap madeSquare(float error_mm) {
  ErrorMap map;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i) {
      map.surface.vertices_mm.emplace_back(float(i), float(j), 50.f);
      map.absolute_mm.push_back(std::abs(error_mm));
      map.signed_mm.push_back(error_mm);
    }
  map.reference.vertices_mm = {{-9, -9, 50}, {48, -9, 50}, {48, 48, 50}, {-9, 48, 50}};
  map.reference.triangles = {{0, 1, 2}, {0, 2, 3}};
  map.look = {0, 0, 1};
  map.up = {0, -1, 0};
  return map;
}

TEST(ErrorMapFigure, ShowsTheErrorsInTheColoursOfTheBar) {
  try {
    offscreenDescription();
  } catch (const BackendError& error) {
    GTEST_SKIP() << error.what();
  }
  const ErrorMap map = madeSquare(-0.5f);
  ErrorMapFigureStyle style;
  const VectorDrawing drawing =
      drawErrorMaps({{"Distance", &map, false}, {"Signed", &map, true}}, style);
  std::vector<const DrawnPicture*> pictures;
  for (const auto& part : drawing.parts)
    if (const auto* picture = std::get_if<DrawnPicture>(&part)) pictures.push_back(picture);
  ASSERT_GE(pictures.size(), 2u);
  const auto middle = [](const DrawnPicture& p) {
    return p.picture.at(p.picture.width_px / 2, p.picture.height_px / 2);
  };
  const Rgb8 plain = middle(*pictures[0]), with_sign = middle(*pictures[1]);
  EXPECT_NEAR(plain.red, 33, 4);  // viridis at 0.5 of 1 mm
  EXPECT_NEAR(plain.green, 145, 4);
  EXPECT_NEAR(plain.blue, 141, 4);
  EXPECT_GT(int(with_sign.blue), with_sign.red + 50) << "inside is blue";
  // Every panel has its letter; its title and the scale lie above the picture, not on it.
  std::vector<std::string> titles;
  for (const auto& part : drawing.parts) {
    const auto* text = std::get_if<DrawnText>(&part);
    if (text == nullptr || text->at.y_pt > pictures[0]->bottom_right.y_pt) continue;
    titles.push_back(text->text);
    EXPECT_LT(text->at.y_pt, pictures[0]->top_left.y_pt) << text->text;
  }
  EXPECT_THAT(titles, testing::IsSupersetOf({"(a) Distance", "(b) Signed"}));
  EXPECT_THROW(drawErrorMaps({}, style), Error);
}

}  // namespace
}  // namespace softscope
