// tests/apps/test_report.cpp: `softscope report`: its options, its lines and its exit codes.
#include <algorithm>

#include "support/made_case.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

using testing::HasSubstr;

class Report : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    writeCase(at("result"), 0.5);
  }
  Outcome report(std::vector<std::string> more) const {
    more.insert(more.begin(), "report");
    more.insert(more.end(), {"--out", at("page.html")});
    return run(more);
  }
};

TEST_F(Report, OptionsReachThePage) {
  writeCase(at("other"), 0.4);
  writeCase(at("second"), 0.3);
  writeCase(at("third"), 0.2);
  const Outcome outcome =
      report({at("result"),   at("other"),  "--name",       "first",     "--name",      "next",
              "--versus",     at("second"), "--versus",     at("third"), "--title",     "Two cases",
              "--limit-mm",   "3",          "--seed",       "7",         "--checklist", "claim",
              "--with-paths", "--pdf",      at("page.pdf"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["cases"][0]["name"], "first");
  EXPECT_EQ(outcome.json()["colour_limit_mm"], 3);
  EXPECT_NEAR(outcome.json()["cohort"]["mean_mm"]["versus"]["mean_difference"], 0.2, 1e-12);
  const std::string html = textOf(at("page.html"));
  for (const std::string& part : {std::string("Two cases"), std::string("next"),
                                  std::string("<h2>Reporting checklist"), at("result/run")})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(textOf(at("page.pdf")), testing::StartsWith("%PDF"));
}

TEST_F(Report, ALimitThatFailsSetsTheExitCode) {
  EXPECT_EQ(report({at("result"), "--fail-if", "p95_mm>50"}).exit_code, 0);
  EXPECT_EQ(report({at("result"), "--force", "--fail-if", "p95_mm>0.001"}).exit_code, 1);
  EXPECT_EQ(report({at("result"), "--force", "--fail-if", "p59_mm>1"}).exit_code, 2);
}

TEST_F(Report, WrongOptionsAreUsageErrors) {
  write("page.html", "mine");
  EXPECT_EQ(report({at("result")}).exit_code, 2);
  EXPECT_EQ(textOf(at("page.html")), "mine");
  EXPECT_EQ(report({at("result"), "--checklist", "clame", "--force"}).exit_code, 2);
  EXPECT_EQ(report({at("result"), "--pdf", at("q.html"), "--force"}).exit_code, 2);
}

TEST_F(Report, BadInputEndsInOneLine) {
  const Outcome outcome = report({at("nowhere")});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
  for (const char* part : {"nowhere", "is not there"}) EXPECT_THAT(outcome.err, HasSubstr(part));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.out.empty());
}

}  // namespace
}  // namespace softscope::test
