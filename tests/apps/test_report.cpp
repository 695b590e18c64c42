// tests/apps/test_report.cpp: `softscope report` on what evaluate and compare wrote.
#include "io/images/image_writer.h"
#include "tests/apps/evaluate_fixture.h"
#include "tests/apps/made_case.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Report : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    writeCase(at("result"), 0.5);
  }
  Outcome report(std::vector<std::string> more, const std::string& out = "page.html") const {
    more.insert(more.begin(), "report");
    more.insert(more.end(), {"--out", at(out)});
    return softscope::test::run(more);
  }
  std::string page(std::vector<std::string> more) const {
    more.push_back("--force");
    const Outcome outcome = report(std::move(more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return textOf(at("page.html"));
  }
  static void expectRefused(const std::vector<std::string>& parts, const Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  }
};

TEST_F(Report, TellsAnEvaluationInReadingOrder) {
  const std::string html = page({at("result")});
  std::size_t place = html.find("Research use only, not for diagnosis.");
  for (const char* title : {"What was compared", "Result, and how sure it is", "Pictures", "Limits",
                            "Methods", "Provenance"}) {
    const std::size_t next = html.find("<h2>" + std::string(title), place);
    ASSERT_NE(next, std::string::npos) << title;
    place = next;
  }
  EXPECT_THAT(html, HasSubstr("id=\"maps\""));
  EXPECT_THAT(html, HasSubstr("Error over time"));
  EXPECT_THAT(html, HasSubstr("Spread of the distances"));
  EXPECT_THAT(html, Not(HasSubstr("http:")));
}

TEST_F(Report, OneCaseIsReviewedLikeSeveral) {
  const std::string html = page({at("result"), "--name", "first"});
  for (const char* part : {"id=\"review\"", "name=\"reviewer\"", "name=\"decision\"",
                           "id=\"cases\">[\"first\"]<", "content_sha256"})
    EXPECT_THAT(html, HasSubstr(part));
}

TEST_F(Report, PathsStayOutUnlessTheyAreAskedFor) {
  const std::string folder_name = folder.filename();
  EXPECT_THAT(page({at("result")}), Not(HasSubstr(folder_name)));
  EXPECT_THAT(page({at("result"), "--with-paths"}), HasSubstr(at("result/run")));
}

TEST_F(Report, JsonHoldsTheNumbersOfTheEvaluation) {
  const Outcome outcome = report({at("result"), "--json", "--name", "<b>first</b>"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json metrics = outcome.json(), record = Json::parse(textOf(at("result/evaluation.json")));
  EXPECT_EQ(metrics["schema_version"], 1);
  EXPECT_EQ(metrics["cases"][0]["name"], "<b>first</b>");
  EXPECT_EQ(metrics["cases"][0]["record"]["surface"], record["surface"]);
  EXPECT_FALSE(metrics["cases"][0]["record"].contains("inputs"));
  EXPECT_THAT(textOf(at("page.html")), Not(HasSubstr("<b>first")));
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("&lt;b&gt;first"));
}

TEST_F(Report, ALimitThatFailsSetsTheExitCodeAndIsInThePage) {
  EXPECT_EQ(report({at("result"), "--fail-if", "p95_mm>50"}).exit_code, 0);
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("kept"));
  const Outcome failed = report({at("result"), "--force", "--fail-if", "p95_mm>0.001"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("FAILED"));
  EXPECT_EQ(report({at("result"), "--force", "--fail-if", "p59_mm>1"}).exit_code, 2);
}

TEST_F(Report, NothingIsOverwrittenUnlessAsked) {
  write("page.html", "mine");
  EXPECT_EQ(report({at("result")}).exit_code, 2);
  EXPECT_EQ(textOf(at("page.html")), "mine");
}

TEST_F(Report, AFileIsWhatItsNameSays) {
  for (const auto& [html, pdf] : std::initializer_list<std::pair<const char*, const char*>>{
           {"p.pdf", "q.pdf"}, {"p", "q.pdf"}, {"p.html", "q.html"}}) {
    const Outcome outcome =
        run({"report", at("result"), "--out", at(html), "--pdf", at(pdf), "--force"});
    EXPECT_EQ(outcome.exit_code, 2) << html << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("must end in"));
    EXPECT_FALSE(fs::exists(at(html)));
  }
}

TEST_F(Report, BadInputsAreNamedAndLeaveNoPage) {
  fs::create_directories(at("empty"));
  fs::create_directories(at("broken"));
  write("broken/evaluation.json", "{\"schema_version\": 1, ");
  fs::create_directories(at("foreign"));
  write("foreign/evaluation.json", "{\"schema_version\": 1, \"command\": \"<b>\"}");
  fs::create_directories(at("newer"));
  write("newer/evaluation.json", "{\"schema_version\": 2, \"command\": \"evaluate\"}");
  fs::create_directories(at("hollow"));
  write("hollow/evaluation.json", "{\"schema_version\": 1, \"command\": \"evaluate\"}");
  expectRefused({"nowhere", "is not there"}, report({at("nowhere")}));
  expectRefused({"empty", "holds no evaluation.json"}, report({at("empty")}));
  expectRefused({"broken/evaluation.json", "is no JSON"}, report({at("broken")}));
  expectRefused({"foreign/evaluation.json", "written by `<b>`"}, report({at("foreign")}));
  expectRefused({"newer/evaluation.json", "schema_version 2"}, report({at("newer")}));
  expectRefused({"hollow/evaluation.json", "no part `surface`"}, report({at("hollow")}));
  fs::create_directories(at("run"));
  write("run/trajectory.txt", "");
  expectRefused({"run", "has not been judged yet"}, report({at("run")}));
  write("result/errors/000002.vtp", "not VTK");
  expectRefused({"000002.vtp"}, report({at("result")}));
  writeCase(at("pictured"), 1);
  write("pictured/figure.png", "<svg onload=alert(1)>");
  expectRefused({"figure.png", "is no PNG"}, report({at("pictured")}));
  EXPECT_FALSE(fs::exists(at("page.html")));
}

TEST_F(Report, SeveralCasesBecomeACohort) {
  for (int i = 0; i < 4; ++i) writeCase(at("case" + std::to_string(i)), 0.1 * (i + 1));
  const std::vector<std::string> cases{at("case0"), at("case1"), at("case2"), at("case3")};
  std::vector<std::string> line = cases;
  line.insert(line.end(), {"--json", "--pdf", at("page.pdf")});
  const Outcome outcome = report(line);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json cohort = outcome.json()["cohort"];
  EXPECT_NEAR(cohort["mean_mm"]["mean"], 0.25, 1e-12);
  EXPECT_NEAR(cohort["mean_mm"]["sd"], std::sqrt(0.05 / 3), 1e-12);
  EXPECT_NEAR(cohort["p95_mm"]["median"], 0.5, 1e-12);
  EXPECT_NEAR(cohort["agreement"]["bias_mm"], -0.25, 1e-12);
  const std::string html = textOf(at("page.html"));
  for (const char* part : {"Bland-Altman", "id=\"review\"", "Case 4", "id=\"cases\"",
                           "name=\"reviewer\"", "name=\"decision\"", "content_sha256"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_EQ(std::string(outcome.json()["content_sha256"]).size(), 64u);
  EXPECT_EQ(outcome.json()["colour_limit_mm"], 1) << "above the largest P95, 0.8, for all cases";
  EXPECT_THAT(textOf(at("page.pdf")), testing::StartsWith("%PDF"));
}

TEST_F(Report, WithoutTruthItSaysSoAndClaimsNoDistance) {
  writeTruthlessCase(at("real"), 28);
  const std::string html = page({at("real")});
  for (const char* part :
       {"There is no ground truth: how far the model lies from the tissue is not known.",
        "a PSNR of 28.0 dB", "it lies 0.250 mm on average from the depth that it was made of",
        "over 75.0 % of the tissue", "judged at 4 moments",
        "an interval over them would be too narrow",
        "Not measured, because it takes ground truth: surface errors; errors of the drawn depth.",
        ">frame<", "back-projection [mm]"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* part :
       {"Mean distance", "95th percentile", "id=\"maps\"", "HD95", "time [s]", "95 % confidence"})
    EXPECT_THAT(html, Not(HasSubstr(part)));
  EXPECT_EQ(report({at("real"), "--fail-if", "psnr_db<30", "--force"}).exit_code, 1);
  EXPECT_EQ(report({at("real"), "--fail-if", "p95_mm>1", "--force"}).exit_code, 2);
}

TEST_F(Report, WithoutTruthTheFirstPictureIsTheModelBesideTheImage) {
  writeTruthlessCase(at("real"), 28);
  Json record = Json::parse(textOf(at("real/evaluation.json")));
  record["drawn_view"] = {{"frame", 30}, {"covers_share", 0.75}, {"age_frames", 2}};
  write("real/evaluation.json", record.dump());
  writePng(at("real/drawn_view.png"), ColourImage(64, 24, {90, 60, 50}));
  const std::string html = page({at("real")});
  const std::size_t picture = html.find("<img");
  ASSERT_NE(picture, std::string::npos);
  EXPECT_LT(picture, html.find("<h2>What was compared"));
  EXPECT_THAT(html, HasSubstr("image of frame 30"));
  EXPECT_THAT(html, HasSubstr("It covers 75.0 % of the tissue in sight. It is 2 frames old"));
  EXPECT_THAT(html, HasSubstr("of the moments for which a model was saved"))
      << "why it is not the share that has depth";
  write("real/drawn_view.png", "none");
  expectRefused({"drawn_view.png", "is no PNG"}, report({at("real"), "--force"}));
}

TEST_F(Report, AChecklistNamesEachItemAndItsPlace) {
  const std::string html = page({at("result"), "--checklist", "claim"});
  EXPECT_THAT(html, HasSubstr("<h2>Reporting checklist"));
  for (const char* part : {"definition of the reference standard", ">42<", "left to the author"})
    EXPECT_THAT(html, HasSubstr(part));
  const std::string stard = page({at("result"), "--checklist", "stard-ai"});
  // Each row by its number: items 15, 16, 17, 26 and 40 have parts.
  const auto at_table = stard.find("STARD-AI (2025)");
  ASSERT_NE(at_table, std::string::npos);
  for (int item = 1; item <= 40; ++item) {
    const std::string number = std::to_string(item);
    std::string parts = "-";
    if (item == 15) parts = "abcd";
    if (item == 16) parts = "abc";
    if (item == 17 || item == 26 || item == 40) parts = "ab";
    for (const char part : parts)
      EXPECT_NE(
          stard.find(">" + number + (part == '-' ? "" : std::string(1, part)) + "<", at_table),
          std::string::npos)
          << number << part;
  }
  EXPECT_THAT(stard, HasSubstr("ethics approval"));
  EXPECT_THAT(stard, Not(HasSubstr("CLAIM")));
  EXPECT_THAT(page({at("result")}), Not(HasSubstr("Reporting checklist")));
  EXPECT_EQ(report({at("result"), "--checklist", "clame", "--force"}).exit_code, 2);
}

TEST_F(Report, NoHeadingStandsAlone) {
  writeTruthlessCase(at("real"), 28);
  Json record = Json::parse(textOf(at("real/evaluation.json")));
  record["frames"] = Json::array();  // nothing to plot, and no map
  write("real/evaluation.json", record.dump());
  writeTruthlessCase(at("other"), 28);
  for (const auto& cases : {std::vector<std::string>{at("real")}, {at("real"), at("other")}})
    EXPECT_THAT(page(cases), Not(HasSubstr("<h2>Pictures")));
}

TEST_F(Report, SmallNumbersAndCountsAreReadable) {
  Json record = Json::parse(textOf(at("result/evaluation.json")));
  record["surface"]["drift_mm_per_frame"] = 0.0000304;
  record["surface"]["drift_mm_per_s"] = -0.0004;
  record["surface"]["jitter_rms_mm"] = 0.0025;
  record["held_out"] = {{"every", 8}, {"views", 2}, {"psnr_db", 33.7}};
  write("result/evaluation.json", record.dump());
  const std::string html = page({at("result")});
  for (const char* part : {"drift [mm per frame]", ">0.000030<", ">-0.00040<", ">0.003<", ">value<",
                           "that the run did not see, over 2 frames"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(html, Not(HasSubstr(">2.00<"))) << "a count has no decimals";
}

TEST_F(Report, CasesWithoutTruthDontCountAmongTheDistances) {
  writeTruthlessCase(at("real"), 28);
  writeTruthlessCase(at("other"), 32);
  const std::string mixed = page({at("result"), at("real"), at("other")});
  EXPECT_THAT(mixed, HasSubstr("In one case the model lies 0.500"));
  EXPECT_THAT(mixed, HasSubstr("2 more have no ground truth"));
  const Outcome blind = report({at("real"), at("other"), "--force", "--json"});
  ASSERT_EQ(blind.exit_code, 0) << blind.err;
  EXPECT_NEAR(blind.json()["cohort"]["psnr_db"]["mean"], 30, 1e-12);
  EXPECT_FALSE(blind.json()["cohort"].contains("mean_mm"));
  const std::string html = textOf(at("page.html"));
  EXPECT_THAT(html, HasSubstr("None of the 2 cases has ground truth"));
  EXPECT_THAT(html, Not(HasSubstr("mean distance")));
}

TEST_F(Report, ACaseWithoutValuesIsNotTheWorst) {
  writeCase(at("blank"), 0.1);
  Json record = Json::parse(textOf(at("blank/evaluation.json")));
  record["surface"]["p95_mm"] = nullptr;
  write("blank/evaluation.json", record.dump());
  writeCase(at("good"), 0.2);
  writeCase(at("bad"), 0.4);
  const std::string html = page(
      {at("blank"), at("good"), at("bad"), "--name", "blank", "--name", "good", "--name", "bad"});
  const std::size_t tile = html.find("Worst case by P95");
  ASSERT_NE(tile, std::string::npos);
  EXPECT_THAT(html.substr(tile, 120), HasSubstr("bad"));
}

TEST_F(Report, TwoMethodsArePairedCaseByCase) {
  std::vector<std::string> line;
  for (int i = 0; i < 3; ++i) {
    writeCase(at("a" + std::to_string(i)), 0.2 + 0.1 * i);
    writeCase(at("b" + std::to_string(i)), 0.3 + 0.1 * i);
    line.insert(line.end(), {at("a" + std::to_string(i)), "--versus", at("b" + std::to_string(i))});
  }
  line.push_back("--json");
  const Outcome outcome = report(line);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json versus = outcome.json()["cohort"]["mean_mm"]["versus"];
  EXPECT_NEAR(versus["mean_difference"], -0.1, 1e-12);
  EXPECT_NEAR(versus["signed_rank_p"], 0.25, 1e-12) << "2 of 8 signs";
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("Two methods, the same cases"));
  EXPECT_EQ(report({at("a0"), at("a1"), "--versus", at("b0"), "--force"}).exit_code, 2);
  EXPECT_EQ(report({at("a0"), at("a1"), "--name", "one", "--force"}).exit_code, 2);
}

TEST_F(Evaluate, ReportReadsWhatEvaluateAndCompareWrite) {
  ASSERT_EQ(evaluate({"--out", at("result"), "--no-views"}).exit_code, 0);
  const Outcome of_run =
      softscope::test::run({"report", at("result"), "--out", at("run.html"), "--json"});
  ASSERT_EQ(of_run.exit_code, 0) << of_run.err;
  EXPECT_EQ(of_run.json()["cases"][0]["record"]["surface"],
            Json::parse(textOf(at("result/evaluation.json")))["surface"]);
  EXPECT_EQ(of_run.json()["cases"][0]["sha256"].size(), 1u + kFrames) << "a map a frame";
  const std::string mesh = at("truth/groundtruth/mesh/000000.ply");
  ASSERT_EQ(softscope::test::run({"compare", "--reference", mesh, "--test", mesh, "--align", "icp",
                                  "--out", at("pair")})
                .exit_code,
            0);
  const Outcome of_pair = softscope::test::run({"report", at("pair"), "--out", at("pair.html")});
  ASSERT_EQ(of_pair.exit_code, 0) << of_pair.err;
  EXPECT_THAT(textOf(at("pair.html")), HasSubstr("before the alignment"));
  EXPECT_THAT(textOf(at("pair.html")), HasSubstr("\"triangles\""));
}

TEST_F(Report, ARecordWithOddTypesIsReportedAsNotMeasured) {
  write("result/evaluation.json",
        R"({"schema_version":1,"command":"evaluate","surface":{"mean_mm":"1","p95_mm":null},)"
        R"("frames":[3,{"mean_mm":1}],"warnings":[7,"a <b> in secret/place.ply"],)"
        R"("error_histogram":{"low_mm":0,"high_mm":1,"counts":["x"]},"thresholds":[1]})");
  const std::string html = page({at("result")});
  EXPECT_THAT(html, HasSubstr("not measured"));
  EXPECT_THAT(html, HasSubstr("a &lt;b&gt; in [file]"));
  EXPECT_THAT(html, Not(HasSubstr("secret")));
}

}  // namespace
}  // namespace softscope::test
