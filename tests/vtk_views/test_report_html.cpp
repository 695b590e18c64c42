// tests/vtk_views/test_report_html.cpp: what a page shows, hides and carries.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "vtk_views/drawing/html_text.h"
#include "vtk_views/report/report_html.h"

namespace softscope {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kHostile = "</script><img src=x onerror=alert(1)>\"'& \x01\xFF{{title}}";

ReportPage madePage(const std::string& word) {
  ReportPage page;
  page.title = "Title " + word;
  page.subtitle = word;
  page.notice = "Research use only, not for diagnosis.";
  page.metrics_json = "{\"schema_version\":1,\"name\":" + jsonQuoted(word) + "}";
  VectorDrawing drawing;
  drawing.width_pt = drawing.height_pt = 10;
  DrawnText text;
  text.text = word;
  drawing.parts.emplace_back(text);
  ErrorMap map;
  map.surface.vertices_mm = {{-10, 0, 5}, {20, 1, 7}, {3, 40, 6}};
  map.absolute_mm = {0, 0.5f, 2};
  map.signed_mm = {0, -0.5f, std::nanf("")};
  map.observed = {1, 0, 1};
  page.maps.push_back({word, {map}});
  page.sections = {{"first", "First", {ReportParagraph{word, true}, ReportList{{word}}}},
                   {"second",
                    "Second",
                    {ReportTable{word, {word, "b"}, {{word, "1"}}, false},
                     ReportTiles{{{word, word, word}}}, ReportFigures{{{drawing, word}}}}},
                   {"third", "Third", {ReportMapPlace{word, word}, ReportReview{{word, "b"}}}}};
  return page;
}

/// The JSON of the script element with this id.
json dataIn(const std::string& html, const std::string& id) {
  const std::string open = "<script type=\"application/json\" id=\"" + id + "\">";
  const auto at = html.find(open);
  EXPECT_NE(at, std::string::npos) << id;
  const auto end = html.find("</script>", at);
  return json::parse(html.substr(at + open.size(), end - at - open.size()));
}

std::string decoded(const std::string& text) {
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | unsigned(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += char(word >> bits & 0xFF);
  }
  return bytes;
}

unsigned shortAt(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[2 * i]) |
         static_cast<unsigned>(static_cast<unsigned char>(bytes[2 * i + 1])) << 8;
}

TEST(ReportHtml, NoTextOfAFileBecomesMarkup) {
  const std::string html = reportHtml(madePage(kHostile));
  EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(html, Not(HasSubstr("onerror=alert(1)>\"")));
  EXPECT_THAT(html, HasSubstr("&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;&quot;&#39;&amp;"));
  EXPECT_THAT(html, HasSubstr("{{title}}")) << "what was put in is not filled again";
  EXPECT_EQ(html.find('\x01'), std::string::npos);
  EXPECT_EQ(html.find('\xFF'), std::string::npos) << "the page is UTF-8 throughout";
}

TEST(ReportHtml, AsksTheNetworkForNothing) {
  const std::string html = reportHtml(madePage("case"));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  for (const char* foreign : {"http:", "https:", "//cdn", "@import", "url("})
    EXPECT_THAT(html, Not(HasSubstr(foreign)));
  EXPECT_THAT(html, Not(HasSubstr("<?xml")));
}

TEST(ReportHtml, SectionsStandInTheirOrderUnderTheNotice) {
  const std::string html = reportHtml(madePage("case"));
  std::size_t at = html.find("Research use only, not for diagnosis.");
  for (const char* id : {"first", "second", "third"}) {
    const std::size_t next = html.find("<section id=\"" + std::string(id), at);
    ASSERT_NE(next, std::string::npos) << id;
    at = next;
  }
}

TEST(ReportHtml, DataInsideParsesWhateverTheNames) {
  const std::string html = reportHtml(madePage(kHostile));
  EXPECT_EQ(dataIn(html, "metrics")["schema_version"], 1);
  EXPECT_THAT(dataIn(html, "metrics")["name"].get<std::string>(), HasSubstr("</script><img"));
  EXPECT_EQ(dataIn(html, "cases").size(), 2u);
  EXPECT_EQ(dataIn(html, "maps")["maps"].size(), 1u);
}

TEST(ReportHtml, MapsKeepPlacesAndErrorsWithinTheirSteps) {
  const json map = dataIn(reportHtml(madePage("case")), "maps")["maps"][0];
  const std::string places = decoded(map["moments"][0]["places"]);
  const std::string errors = decoded(map["moments"][0]["errors"]);
  const std::string flags = decoded(map["moments"][0]["flags"]);
  const std::vector<std::array<double, 3>> expected{{-10, 0, 5}, {20, 1, 7}, {3, 40, 6}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double size = map["size_mm"][k];
      EXPECT_NEAR(map["low_mm"][k].get<double>() + shortAt(places, 3 * i + k) * size / 65535,
                  expected[i][k], size / 65535);
    }
  EXPECT_NEAR(shortAt(errors, 1) * map["step_mm"].get<double>(), 0.5, map["step_mm"]);
  EXPECT_EQ(flags, std::string("\x01\x02\x05", 3)) << "observed, inside, no side";
}

TEST(ReportHtml, ThePictureStandsWhereNothingDrawsTheMap) {
  ReportPage page = madePage("case");
  EXPECT_THAT(reportHtml(page), HasSubstr("No picture"));
  page.map_figure = VectorDrawing{};
  page.map_figure->width_pt = page.map_figure->height_pt = 20;
  EXPECT_THAT(reportHtml(page), HasSubstr("src=\"data:image/png;base64,iVBOR"));
}

TEST(ReportHtml, TheSamePageGivesTheSameBytes) {
  EXPECT_EQ(reportHtml(madePage("case")), reportHtml(madePage("case")));
}

TEST(HtmlText, BytesAndLineSeparators) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(scriptSafe("\"<\xE2\x80\xA8>&\""), "\"\\u003c\\u2028\\u003e\\u0026\"");
  EXPECT_EQ(htmlEscaped("\xC3\xA9 \xE2\x89\xA5 \xF0\x9F\x98\x80"),
            "\xC3\xA9 \xE2\x89\xA5 \xF0\x9F\x98\x80");
  EXPECT_EQ(htmlEscaped("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD") << "overlong";
  EXPECT_EQ(json::parse(jsonQuoted("a\"\\\n\x80z")), "a\"\\\xEF\xBF\xBD\xEF\xBF\xBDz");
}

}  // namespace
}  // namespace softscope
