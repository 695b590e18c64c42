// tests/apps/test_report_browser.cpp: a report as a browser without a display shows it.
#include <gmock/gmock.h>

#include <cstdlib>

#include "io/image_reader.h"
#include "tests/apps/evaluate_fixture.h"
#include "tests/apps/made_case.h"

namespace softscope::test {
namespace {

/// Empty where none is installed.
std::string findBrowser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0)
      return name;
  return {};
}

/// A bumpy square of points whose error rises from left to right, 0 to 1 mm.
ErrorMap risingMap() {
  ErrorMap map;
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i) {
      map.surface.vertices_mm.emplace_back(float(i), float(j), 50 + std::sin(0.3f * float(j)));
      map.absolute_mm.push_back(float(i) / 59);
      map.signed_mm.push_back(float(i) / 59);
    }
  map.look = {0, 0, 1};
  map.up = {0, -1, 0};
  return map;
}

using ReportInBrowser = InFolder;

TEST_F(ReportInBrowser, DrawsTheMapInItsColoursAndComplainsOfNothing) {
  const std::string browser = findBrowser();
  if (browser.empty()) GTEST_SKIP() << "no Chromium is installed: the page was not looked at";
  writeCase(at("result"), 0.5, risingMap());
  // Made where nothing renders, the page has no picture to fall back on: colours are WebGL's.
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1);
  const Outcome made = softscope::test::run({"report", at("result"), "--out", at("page.html")});
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  ASSERT_THAT(textOf(at("page.html")), testing::HasSubstr("No picture"));
  // Software WebGL; nothing can be resolved, so that a request would fail aloud.
  const std::string command =
      "timeout 120 " + browser +
      " --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader"
      " --enable-unsafe-swiftshader --hide-scrollbars --window-size=1000,2600"
      " --virtual-time-budget=3000 --host-resolver-rules='MAP * ~NOTFOUND'"
      " --enable-logging=stderr --user-data-dir='" +
      at("profile") + "' --screenshot='" + at("page.png") + "' 'file://" + at("page.html") +
      "' >'" + at("log") + "' 2>&1";
  std::system(command.c_str());
  const std::string log = textOf(at("log"));
  ASSERT_TRUE(std::filesystem::exists(at("page.png"))) << browser << " made no picture: " << log;
  EXPECT_THAT(log, testing::Not(testing::HasSubstr("CONSOLE"))) << "a script or a request failed";
  const ColourImage picture = readColourImage(at("page.png"));
  // Viridis: dark violet at 0, yellow at the end; no other part of the page has as much of them.
  int violet = 0, yellow = 0;
  for (const Rgb8& c : picture.values) {
    violet += c.red < 90 && c.green < 60 && c.blue > 70 && c.blue < 140;
    yellow += c.red > 200 && c.green > 200 && c.blue < 90;
  }
  EXPECT_GT(violet, 15000) << "of a map of 480 x 480 pixels a tenth has the lowest colours";
  EXPECT_GT(yellow, 5000);
}

}  // namespace
}  // namespace softscope::test
