// tests/apps/test_report_browser.cpp: a report as a browser without a display shows it.
#include <gmock/gmock.h>

#include <cstdlib>

#include "io/images/image_reader.h"
#include "support/made_case.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

using testing::HasSubstr;
using testing::Not;

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

class ReportInBrowser : public InFolder {
 protected:
  /// Makes page.html of these cases. Made where nothing renders, it has no picture to fall back on:
  /// what is seen is WebGL's.
  void makePage(std::vector<std::string> cases) const {
    cases.insert(cases.begin(), "report");
    cases.insert(cases.end(), {"--out", at("page.html")});
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1);
    const Outcome made = softscope::test::run(cases);
    unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    ASSERT_THAT(textOf(at("page.html")), HasSubstr("No picture"));
  }
  /// Opens page.html with software WebGL, where no name can be resolved, so that a request would
  /// fail aloud. Standard output goes to the file `out`, complaints to `log`.
  void open(const std::string& browser, const std::string& what_to_do) const {
    const std::string command =
        "timeout 120 " + browser +
        " --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader"
        " --enable-unsafe-swiftshader --hide-scrollbars --window-size=1000,2600"
        " --virtual-time-budget=3000 --host-resolver-rules='MAP * ~NOTFOUND'"
        " --enable-logging=stderr --user-data-dir='" +
        at("profile") + "' " + what_to_do + " 'file://" + at("page.html") + "' >'" + at("out") +
        "' 2>'" + at("log") + "'";
    if (std::system(command.c_str()) != 0) ADD_FAILURE() << browser << ": " << textOf(at("log"));
    EXPECT_THAT(textOf(at("log")), Not(HasSubstr("CONSOLE"))) << "a script or a request failed";
  }
};

const char* const kNoBrowser = "no Chromium is installed: the page was not looked at";

TEST_F(ReportInBrowser, DrawsTheMapInItsColoursAndComplainsOfNothing) {
  const std::string browser = findBrowser();
  if (browser.empty()) GTEST_SKIP() << kNoBrowser;
  writeCase(at("result"), 0.5, risingMap());
  ASSERT_NO_FATAL_FAILURE(makePage({at("result")}));
  open(browser, "--screenshot='" + at("page.png") + "'");
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

/// Turns, picks, clips, plays and grades as a reader would, and writes down what came of it.
const char* const kReader = R"(<script>
addEventListener("load", () => {
  const told = {}, press = key => document.dispatchEvent(new KeyboardEvent("keydown", {key}));
  const canvas = viewer.canvas, middle = [canvas.clientWidth / 2, canvas.clientHeight / 2];
  viewer.pick(...middle);
  told.picked = document.querySelector(".reading").textContent;
  viewer.control("above").value = viewer.control("above").max;
  viewer.control("above").dispatchEvent(new Event("input"));
  viewer.pick(...middle);
  told.clipped = viewer.picked === null;
  const before = viewer.look.view[0][0];
  canvas.dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowLeft"}));
  told.turned = viewer.look.view[0][0] !== before;
  press("4"); press("n"); press("2"); press("o");
  told.hidden = !viewer.style.model;
  told.shown = viewer.map.name;
  document.querySelector("#review [name=reviewer]").value = "A. Reviewer";
  document.querySelector("#review [name=decision]").value = "rejected";
  told.review = JSON.parse(review.text());
  const out = document.createElement("pre");
  out.id = "told";
  out.textContent = JSON.stringify(told);
  document.body.append(out);
});
</script></body>)";

TEST_F(ReportInBrowser, AnswersClicksAndKeys) {
  const std::string browser = findBrowser();
  if (browser.empty()) GTEST_SKIP() << kNoBrowser;
  writeCase(at("first"), 0.5, risingMap());
  writeCase(at("second"), 0.4, risingMap());
  ASSERT_NO_FATAL_FAILURE(makePage({at("first"), at("second"), "--name", "A", "--name", "B"}));
  std::string html = textOf(at("page.html"));
  html.replace(html.rfind("</body>"), 7, kReader);
  write("page.html", html);
  open(browser, "--dump-dom");
  const std::string dom = textOf(at("out")), begin = "<pre id=\"told\">";
  ASSERT_THAT(dom, HasSubstr(begin));
  const auto from = dom.find(begin) + begin.size();
  const Json told = Json::parse(dom.substr(from, dom.find("</pre>", from) - from));
  // The middle of a square of 0 to 59 mm, where the error is half of 1 mm, within a spacing or two.
  const std::string picked = told["picked"];
  EXPECT_NEAR(std::stod(picked), 0.5, 0.06) << picked;
  EXPECT_THAT(picked, HasSubstr("outside the reference"));
  EXPECT_EQ(told["clipped"], true) << "nothing is above the largest error";
  EXPECT_EQ(told["turned"], true);
  EXPECT_EQ(told["hidden"], true);
  EXPECT_EQ(told["shown"], "B");
  EXPECT_EQ(told["review"]["grades"][0]["grade"], 4);
  EXPECT_EQ(told["review"]["grades"][1]["grade"], 2);
  EXPECT_EQ(std::string(told["review"]["report_sha256"]).size(), 64u);
  EXPECT_EQ(told["review"]["reviewer"], "A. Reviewer");
  EXPECT_EQ(told["review"]["decision"], "rejected");
  EXPECT_THAT(std::string(told["review"]["saved"]), testing::ContainsRegex("^20.*T.*Z$"));
}

}  // namespace
}  // namespace softscope::test
