// tests/toolkit/report_test.cpp: the page of evaluations and comparisons.
#include "io/images/image_writer.h"
#include "support/made_case.h"
#include "tests/toolkit/evaluation_fixture.h"
#include "toolkit/comparison/compare_files.h"
#include "toolkit/comparison/compare_outputs.h"
#include "toolkit/report/write_report.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ReportPages : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    writeCase(at("result"), 0.5);
  }
  /// Of these folders, to page.html.
  ReportOptions options(const std::vector<std::string>& cases) const {
    ReportOptions options;
    options.cases = cases;
    options.html = at("page.html");
    options.overwrite = true;
    return options;
  }
  std::string page(const ReportOptions& options) const {
    writeReport(options);
    return textOf(options.html);
  }
  std::string page(const std::vector<std::string>& cases) const { return page(options(cases)); }
  static std::vector<ThresholdOutcome> outcomesOf(ReportOptions options, const std::string& limit) {
    options.thresholds = limits({limit});
    return writeReport(options).outcomes;
  }
  void expectRefused(const std::vector<std::string>& parts, const std::string& name) const {
    expectError<InputError>([&] { writeReport(options({at(name)})); }, parts);
  }
};

TEST_F(ReportPages, TellsAnEvaluationInReadingOrder) {
  const std::string html = page({at("result")});
  std::size_t place = html.find("Research use only, not for diagnosis.");
  for (const char* title : {"What was compared", "Result and uncertainty", "Pictures", "Limits",
                            "Methods", "Provenance"}) {
    const std::size_t next = html.find("<h2>" + std::string(title), place);
    ASSERT_NE(next, std::string::npos) << title;
    place = next;
  }
  EXPECT_THAT(html, HasSubstr("id=\"maps\""));
  EXPECT_THAT(html, HasSubstr("Error over time"));
  EXPECT_THAT(html, HasSubstr("Histogram of the distances"));
  EXPECT_THAT(html, Not(HasSubstr("http:")));
}

TEST_F(ReportPages, OneCaseIsReviewedLikeSeveral) {
  ReportOptions named = options({at("result")});
  named.names = {"first"};
  const std::string html = page(named);
  for (const char* part : {"id=\"review\"", "name=\"reviewer\"", "name=\"decision\"",
                           "id=\"cases\">[\"first\"]<", "content_sha256"})
    EXPECT_THAT(html, HasSubstr(part));
}

TEST_F(ReportPages, PathsStayOutUnlessTheyAreAskedFor) {
  const std::string folder_name = folder.filename();
  EXPECT_THAT(page({at("result")}), Not(HasSubstr(folder_name)));
  ReportOptions with_paths = options({at("result")});
  with_paths.with_paths = true;
  EXPECT_THAT(page(with_paths), HasSubstr(at("result/run")));
}

TEST_F(ReportPages, MetricsAreTheNumbersOfTheEvaluation) {
  ReportOptions named = options({at("result")});
  named.names = {"<b>first</b>"};
  const Json metrics = written(writeReport(named).metrics),
             record = Json::parse(textOf(at("result/evaluation.json")));
  EXPECT_EQ(metrics["schema_version"], 1);
  EXPECT_EQ(metrics["cases"][0]["name"], "<b>first</b>");
  EXPECT_EQ(metrics["cases"][0]["record"]["surface"], record["surface"]);
  EXPECT_FALSE(metrics["cases"][0]["record"].contains("inputs"));
  EXPECT_THAT(textOf(at("page.html")), Not(HasSubstr("<b>first")));
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("&lt;b&gt;first"));
}

TEST_F(ReportPages, ALimitThatFailsIsInThePage) {
  EXPECT_FALSE(outcomesOf(options({at("result")}), "p95_mm>50").at(0).failed);
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("kept"));
  EXPECT_TRUE(outcomesOf(options({at("result")}), "p95_mm>0.001").at(0).failed);
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("FAILED"));
  expectError<OptionError>([&] { outcomesOf(options({at("result")}), "p59_mm>1"); }, {"p59_mm"});
}

TEST_F(ReportPages, NothingIsOverwrittenUnlessAsked) {
  write("page.html", "mine");
  ReportOptions careful = options({at("result")});
  careful.overwrite = false;
  expectError<OptionError>([&] { writeReport(careful); }, {"page.html"});
  EXPECT_EQ(textOf(at("page.html")), "mine");
}

TEST_F(ReportPages, AFileIsWhatItsNameSays) {
  for (const auto& [html, pdf] : std::initializer_list<std::pair<const char*, const char*>>{
           {"p.pdf", "q.pdf"}, {"p", "q.pdf"}, {"p.html", "q.html"}}) {
    ReportOptions misnamed = options({at("result")});
    misnamed.html = at(html);
    misnamed.pdf = at(pdf);
    expectError<OptionError>([&] { writeReport(misnamed); }, {"must end in"});
    EXPECT_FALSE(fs::exists(at(html)));
  }
}

TEST_F(ReportPages, BadInputsAreNamedAndLeaveNoPage) {
  fs::create_directories(at("empty"));
  fs::create_directories(at("broken"));
  write("broken/evaluation.json", "{\"schema_version\": 1, ");
  fs::create_directories(at("foreign"));
  write("foreign/evaluation.json", "{\"schema_version\": 1, \"command\": \"<b>\"}");
  fs::create_directories(at("newer"));
  write("newer/evaluation.json", "{\"schema_version\": 2, \"command\": \"evaluate\"}");
  fs::create_directories(at("hollow"));
  write("hollow/evaluation.json", "{\"schema_version\": 1, \"command\": \"evaluate\"}");
  expectRefused({"nowhere", "is not there"}, "nowhere");
  expectRefused({"empty", "contains no evaluation.json"}, "empty");
  expectRefused({"broken/evaluation.json", "is no JSON"}, "broken");
  expectRefused({"foreign/evaluation.json", "written by `<b>`"}, "foreign");
  expectRefused({"newer/evaluation.json", "schema_version 2"}, "newer");
  expectRefused({"hollow/evaluation.json", "no part `surface`"}, "hollow");
  fs::create_directories(at("run"));
  write("run/trajectory.txt", "");
  expectRefused({"run", "is a run without evaluation"}, "run");
  write("result/errors/000002.vtp", "not VTK");
  expectRefused({"000002.vtp"}, "result");
  writeCase(at("pictured"), 1);
  write("pictured/figure.png", "<svg onload=alert(1)>");
  expectRefused({"figure.png", "is not a PNG"}, "pictured");
  EXPECT_FALSE(fs::exists(at("page.html")));
}

TEST_F(ReportPages, SeveralCasesBecomeACohort) {
  for (int i = 0; i < 4; ++i) writeCase(at("case" + std::to_string(i)), 0.1 * (i + 1));
  ReportOptions all = options({at("case0"), at("case1"), at("case2"), at("case3")});
  all.pdf = at("page.pdf");
  const Json metrics = written(writeReport(all).metrics);
  const Json& cohort = metrics["cohort"];
  EXPECT_NEAR(cohort["mean_mm"]["mean"], 0.25, 1e-12);
  EXPECT_NEAR(cohort["mean_mm"]["sd"], std::sqrt(0.05 / 3), 1e-12);
  EXPECT_NEAR(cohort["p95_mm"]["median"], 0.5, 1e-12);
  EXPECT_NEAR(cohort["agreement"]["bias_mm"], -0.25, 1e-12);
  const std::string html = textOf(at("page.html"));
  for (const char* part : {"Bland-Altman", "id=\"review\"", "Case 4", "id=\"cases\"",
                           "name=\"reviewer\"", "name=\"decision\"", "content_sha256"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_EQ(std::string(metrics["content_sha256"]).size(), 64u);
  EXPECT_EQ(metrics["colour_limit_mm"], 1) << "above the largest P95, 0.8, for all cases";
  EXPECT_THAT(textOf(at("page.pdf")), testing::StartsWith("%PDF"));
}

TEST_F(ReportPages, WithoutTruthItSaysSoAndClaimsNoDistance) {
  writeTruthlessCase(at("real"), 28);
  const std::string html = page({at("real")});
  for (const char* part :
       {"There is no ground truth: the distance of the model from the tissue is unknown.",
        "a PSNR of 28.0 dB",
        "Visible points are 0.250 mm on average from the depth used for the model",
        "over 75.0 % of the tissue", "evaluated at 4 frames",
        "an interval over them would be too narrow",
        "Not measured, because ground truth is required: surface errors; errors of the drawn "
        "depth.",
        ">frame<", "back-projection [mm]"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* part :
       {"Mean distance", "95th percentile", "id=\"maps\"", "HD95", "time [s]", "95 % confidence"})
    EXPECT_THAT(html, Not(HasSubstr(part)));
  EXPECT_TRUE(outcomesOf(options({at("real")}), "psnr_db<30").at(0).failed);
  expectError<OptionError>([&] { outcomesOf(options({at("real")}), "p95_mm>1"); }, {"p95_mm"});
}

TEST_F(ReportPages, WithoutTruthTheFirstPictureIsTheModelBesideTheImage) {
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
  EXPECT_THAT(html, HasSubstr("It covers 75.0 % of the visible tissue. It is 2 frames old"));
  EXPECT_THAT(html, HasSubstr("of the frames with a saved model"))
      << "why it is not the share that has depth";
  write("real/drawn_view.png", "none");
  expectRefused({"drawn_view.png", "is not a PNG"}, "real");
}

TEST_F(ReportPages, AChecklistNamesEachItemAndItsPlace) {
  ReportOptions listed = options({at("result")});
  listed.checklist = "claim";
  const std::string html = page(listed);
  EXPECT_THAT(html, HasSubstr("<h2>Reporting checklist"));
  for (const char* part : {"definition of the reference standard", ">42<", "left to the author"})
    EXPECT_THAT(html, HasSubstr(part));
  listed.checklist = "stard-ai";
  const std::string stard = page(listed);
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
  listed.checklist = "clame";
  expectError<OptionError>([&] { writeReport(listed); }, {"clame"});
}

TEST_F(ReportPages, NoHeadingStandsAlone) {
  writeTruthlessCase(at("real"), 28);
  Json record = Json::parse(textOf(at("real/evaluation.json")));
  record["frames"] = Json::array();  // nothing to plot, and no map
  write("real/evaluation.json", record.dump());
  writeTruthlessCase(at("other"), 28);
  for (const auto& cases : {std::vector<std::string>{at("real")}, {at("real"), at("other")}})
    EXPECT_THAT(page(cases), Not(HasSubstr("<h2>Pictures")));
}

TEST_F(ReportPages, SmallNumbersAndCountsAreReadable) {
  Json record = Json::parse(textOf(at("result/evaluation.json")));
  record["surface"]["drift_mm_per_frame"] = 0.0000304;
  record["surface"]["drift_mm_per_s"] = -0.0004;
  record["surface"]["jitter_rms_mm"] = 0.0025;
  record["held_out"] = {{"every", 8}, {"views", 2}, {"psnr_db", 33.7}};
  write("result/evaluation.json", record.dump());
  const std::string html = page({at("result")});
  for (const char* part : {"drift [mm per frame]", ">0.000030<", ">-0.00040<", ">0.003<", ">value<",
                           "that the run did not use, over 2 frames"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(html, Not(HasSubstr(">2.00<"))) << "a count has no decimals";
}

TEST_F(ReportPages, CasesWithoutTruthDontCountAmongTheDistances) {
  writeTruthlessCase(at("real"), 28);
  writeTruthlessCase(at("other"), 32);
  const std::string mixed = page({at("result"), at("real"), at("other")});
  EXPECT_THAT(mixed, HasSubstr("In one case the distance of the model is 0.500"));
  EXPECT_THAT(mixed, HasSubstr("2 more have no ground truth"));
  const Json blind = written(writeReport(options({at("real"), at("other")})).metrics);
  EXPECT_NEAR(blind["cohort"]["psnr_db"]["mean"], 30, 1e-12);
  EXPECT_FALSE(blind["cohort"].contains("mean_mm"));
  const std::string html = textOf(at("page.html"));
  EXPECT_THAT(html, HasSubstr("None of the 2 cases has ground truth"));
  EXPECT_THAT(html, Not(HasSubstr("mean distance")));
}

TEST_F(ReportPages, ACaseWithoutValuesIsNotTheWorst) {
  writeCase(at("blank"), 0.1);
  Json record = Json::parse(textOf(at("blank/evaluation.json")));
  record["surface"]["p95_mm"] = nullptr;
  write("blank/evaluation.json", record.dump());
  writeCase(at("good"), 0.2);
  writeCase(at("bad"), 0.4);
  ReportOptions named = options({at("blank"), at("good"), at("bad")});
  named.names = {"blank", "good", "bad"};
  const std::string html = page(named);
  const std::size_t tile = html.find("Worst case by P95");
  ASSERT_NE(tile, std::string::npos);
  EXPECT_THAT(html.substr(tile, 120), HasSubstr("bad"));
}

TEST_F(ReportPages, TwoMethodsArePairedCaseByCase) {
  ReportOptions paired = options({});
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    writeCase(at("a" + number), 0.2 + 0.1 * i);
    writeCase(at("b" + number), 0.3 + 0.1 * i);
    paired.cases.push_back(at("a" + number));
    paired.versus.push_back(at("b" + number));
  }
  const Json metrics = written(writeReport(paired).metrics);
  const Json& versus = metrics["cohort"]["mean_mm"]["versus"];
  EXPECT_NEAR(versus["mean_difference"], -0.1, 1e-12);
  EXPECT_NEAR(versus["signed_rank_p"], 0.25, 1e-12) << "2 of 8 signs";
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("Two methods, the same cases"));
  ReportOptions uneven = options({at("a0"), at("a1")});
  uneven.versus = {at("b0")};
  expectError<OptionError>([&] { writeReport(uneven); }, {"versus"});
  uneven.versus.clear();
  uneven.names = {"one"};
  expectError<OptionError>([&] { writeReport(uneven); }, {"name"});
  uneven.limit_mm = -5;
  expectError<OptionError>([&] { writeReport(uneven); }, {"`limit_mm=`", "or 0 for automatic"});
}

/// The page of a comparison that is written to the folder.
std::string reportOf(const CompareOptions& options, const std::string& folder) {
  const FileComparison pair = compareFiles(options);
  CompareOutputs(folder, false).write(pair.result, pair.reference, pair.test, {}, pair.record);
  ReportOptions report;
  report.cases = {folder};
  report.html = folder + ".html";
  writeReport(report);
  return textOf(report.html);
}

TEST_F(Evaluation, ReportReadsWhatEvaluateAndCompareWrite) {
  EvaluateOptions undrawn = options();
  undrawn.views = false;
  EvaluateOutputs(at("result"), false).write(evaluateRun(undrawn));
  ReportOptions of_run;
  of_run.cases = {at("result")};
  of_run.html = at("run.html");
  const Json metrics = written(writeReport(of_run).metrics);
  EXPECT_EQ(metrics["cases"][0]["record"]["surface"],
            Json::parse(textOf(at("result/evaluation.json")))["surface"]);
  EXPECT_EQ(metrics["cases"][0]["sha256"].size(), 1u + kFrames) << "a map a frame";
  CompareOptions same;
  same.reference = same.test = at("truth/groundtruth/mesh/000000.ply");
  same.fit.closest_points = true;
  const std::string html = reportOf(same, at("pair"));
  EXPECT_THAT(html, HasSubstr("before the alignment"));
  EXPECT_THAT(html, HasSubstr("\"triangles\""));
}

TEST_F(Evaluation, TheReportOfAComparisonHasItsObservedPart) {
  CompareOptions same;
  same.reference = same.test = same.observed = at("truth/groundtruth/mesh/000000.ply");
  const std::string html = reportOf(same, at("pair"));
  for (const char* part : {"observed part: model to reference", "observed part: reference to model",
                           "Both ways, observed part",
                           "observed vertices of the reference that are not reconstructed"})
    EXPECT_THAT(html, HasSubstr(part));
}

TEST_F(ReportPages, ARecordWithOddTypesIsReportedAsNotMeasured) {
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
