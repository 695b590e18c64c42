// tests/toolkit/study_test.cpp: cases of a study file; records as a table.
#include <gmock/gmock.h>

#include <cstdlib>

#include "core/error.h"
#include "support/in_folder.h"
#include "toolkit/study/study_case.h"
#include "toolkit/study/study_outputs.h"
#include "toolkit/study/study_settings.h"

namespace softscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class StudyFile : public InFolder {
 protected:
  Study read(const std::string& toml) const { return readStudy(write("study.toml", toml)); }
  std::vector<std::string> namesIn(const std::string& toml) const {
    std::vector<std::string> names;
    for (const StudyCase& one : read(toml).cases) names.push_back(one.name);
    return names;
  }
  std::string complaintAbout(const std::string& toml) const {
    try {
      read(toml);
    } catch (const OptionError& error) {
      return error.what();
    }
    return "nothing";
  }
};

TEST_F(StudyFile, CasesTimesVariantsTimesLevels) {
  EXPECT_THAT(namesIn("[simulate]\nframes = 3\n"), ElementsAre("case"));
  EXPECT_THAT(namesIn("[[case]]\nname = 'a'\n[[case]]\nname = 'b'\n"
                      "[[variant]]\nname = 'x'\n[[variant]]\nname = 'y'\n"),
              ElementsAre("a-x", "a-y", "b-x", "b-y"));
  EXPECT_THAT(namesIn("[[case]]\nname = 'a'\n[[sweep]]\nname = 'blur'\nlevels = [0.5, 2]\n"
                      "simulate.sensor.blur_px = [0.5, 2]\n"),
              ElementsAre("a-blur-0.5", "a-blur-2"));
}

TEST_F(StudyFile, LaterPartsAreStronger) {
  const Study study = read(
      "[simulate]\nframes = 3\nseed = 1\ncamera.distance_mm = 50\n"
      "[[case]]\nname = 'a'\nsimulate.frames = 4\nsimulate.seed = 2\n"
      "[[variant]]\nname = 'x'\nsimulate.seed = 3\nreconstruct.matcher.method = 'sift'\n");
  const StudyCase& one = study.caseNamed("a-x");
  EXPECT_EQ(one.simulate.at("frames"), "4");
  EXPECT_EQ(one.simulate.at("seed"), "3");
  EXPECT_EQ(one.simulate.at("camera.distance_mm"), "50");
  EXPECT_THAT(reconstructionText(one), HasSubstr("matcher.method=sift\n"));
}

TEST_F(StudyFile, WhatTheEnvironmentLacksIsReplacedOrSkipped) {
  unsetenv("SOFTSCOPE_TEST_NOWHERE");
  const Study study = read(
      "[[case]]\nname = 'a'\nsimulate.organ.mesh = '${SOFTSCOPE_TEST_NOWHERE}/a.stl'\n"
      "simulate.organ.otherwise = 'builtin'\n"
      "[[case]]\nname = 'b'\nsimulate.organ.mesh = '${SOFTSCOPE_TEST_NOWHERE}/b.stl'\n"
      "[[case]]\nname = 'c'\nsequence = '${SOFTSCOPE_TEST_NOWHERE}/c'\n");
  EXPECT_EQ(study.cases[0].simulate.at("organ.mesh"), "builtin");
  EXPECT_THAT(study.cases[0].notes, ElementsAre(HasSubstr("built-in organ")));
  EXPECT_THAT(study.cases[1].skip, HasSubstr("b.stl is not here"));
  EXPECT_THAT(study.cases[2].skip, HasSubstr("is not here"));
}

TEST_F(StudyFile, PathsBeginAtTheStudyFileOrAtWhatTheEnvironmentNames) {
  write("meshes/a.stl", "");
  setenv("SOFTSCOPE_TEST_SOMEWHERE", at("meshes").c_str(), 1);
  const Study study = read(
      "[[case]]\nname = 'a'\nsimulate.organ.mesh = 'meshes/a.stl'\n"
      "[[case]]\nname = 'b'\nsimulate.organ.mesh = '${SOFTSCOPE_TEST_SOMEWHERE}/a.stl'\n");
  EXPECT_EQ(study.cases[0].simulate.at("organ.mesh"), at("meshes/a.stl"));
  EXPECT_EQ(study.cases[1].simulate.at("organ.mesh"), at("meshes/a.stl"));
}

TEST_F(StudyFile, SaysWhatIsWrongBeforeAnyWork) {
  EXPECT_THAT(complaintAbout("titel = 'x'\n"), HasSubstr("did you mean `title`"));
  EXPECT_THAT(complaintAbout("[simulate]\nframess = 3\n"), HasSubstr("frames"));
  EXPECT_THAT(complaintAbout("[reconstruct]\nmatcher.methd = 'sift'\n"),
              HasSubstr("matcher.method"));
  EXPECT_THAT(complaintAbout("[evaluate]\nalgn = 'icp'\n"), HasSubstr("evaluate.align"));
  EXPECT_THAT(complaintAbout("[[case]]\nname = 'a/b'\n"), HasSubstr("needs a name"));
  EXPECT_THAT(complaintAbout("[[case]]\nname = 'a'\n[[case]]\nname = 'a'\n"),
              HasSubstr("two cases are called `a`"));
  EXPECT_THAT(complaintAbout("[[sweep]]\nname = 's'\nlevels = [1, 2]\n"
                             "simulate.sensor.blur_px = [1]\n"),
              HasSubstr("a value for each of its 2 levels"));
  EXPECT_THAT(complaintAbout("[[sweep]]\nname = 's'\nlevels = [2, 1]\n"), HasSubstr("rise"));
  EXPECT_THAT(complaintAbout("[simulate]\nframes = [1, 2]\n"), HasSubstr("[[sweep]]"));
  EXPECT_THAT(complaintAbout("[reconstruct]\nbackend = 'cdua'\n"), HasSubstr("mean `cuda`"));
  EXPECT_THAT(complaintAbout("[reconstruct]\npreset = 'papr'\n"), HasSubstr("mean `paper`"));
  EXPECT_THAT(complaintAbout("[reconstruct]\nsave_every = -1\n"), HasSubstr("0 or more"));
  EXPECT_THAT(complaintAbout("[reconstruct]\nframes = '9-3'\n"), HasSubstr("reconstruct.frames"));
  EXPECT_THAT(complaintAbout("[evaluate]\nalign = 'ridgid'\n"), HasSubstr("mean `rigid`"));
  EXPECT_THAT(complaintAbout("[evaluate]\nalign = 'icp'\n"), HasSubstr("is for a mesh"));
}

TEST_F(StudyFile, TruthThatChangedMakesACaseOutdated) {
  const std::string toml =
      "sequence = '" + makeSequence("clip", 2) + "'\n[reconstruct]\nsave_every = 0\n";
  write("clip/groundtruth/mesh/000000.ply", "one");
  write("truth/groundtruth/mesh/000000.ply", "one");
  const std::string with_reference = toml + "[evaluate]\nreference = 'truth'\n";
  const auto digestNow = [&](const std::string& text) { return digestOf(read(text).cases[0]); };
  const std::string own = digestNow(toml), named = digestNow(with_reference);
  write("clip/groundtruth/mesh/000000.ply", "two");
  EXPECT_NE(digestNow(toml), own);
  const std::string named_later = digestNow(with_reference);
  write("truth/groundtruth/mesh/000000.ply", "two");
  EXPECT_NE(digestNow(with_reference), named_later);
  EXPECT_NE(named, named_later);
}

/// One sweep of three levels with a mean of 0.1, 0.7 and none.
struct Swept {
  Study study;
  std::vector<FactSheet::Json> records;

  Swept() {
    study.title = "Noise & <blur>";
    study.sweeps = {{"noise", "noise [%]", {1, 2, 3}}};
    study.plots = {{"points", {"evaluation.tracks.mean_mm", "error [mm]", 3}, "", 0.5}};
    for (const double level : {1.0, 2.0, 3.0}) {
      StudyCase one;
      one.name = "noise-" + std::to_string(int(level));
      one.sweep = "noise";
      one.level = level;
      study.cases.push_back(one);
      FactSheet::Json record{{"name", one.name}, {"status", "done"}, {"reason", ""}};
      record["run"]["fused_share"] = 1.0;
      record["evaluation"]["tracks"]["mean_mm"] = level == 1 ? 0.1 : 0.7;
      records.push_back(record);
    }
    records[2] = {{"name", "noise-3"}, {"status", "failed"}, {"reason", "it, broke"}};
  }
};

TEST(StudyTable, SaysWhereASweepBreaks) {
  Swept swept;
  const auto breaks = breaksOf(swept.study, swept.records);
  ASSERT_EQ(breaks.size(), 1u);
  EXPECT_TRUE(breaks[0].broken);
  EXPECT_EQ(breaks[0].level, 2) << "0.7 mm is above the limit of 0.5";
  swept.study.plots[0].limit = 1;
  EXPECT_EQ(breaksOf(swept.study, swept.records)[0].level, 3) << "a failed case is broken";
  swept.records[0]["run"]["fused_share"] = 0.4;
  EXPECT_EQ(breaksOf(swept.study, swept.records)[0].level, 1) << "most frames were not fused";
}

TEST(StudyTable, LevelsThatWereNotRunDoNotHold) {
  Swept swept;
  swept.study.plots[0].limit = 1;
  swept.records[2] = FactSheet::Json();
  EXPECT_THAT(studyTable(swept.study, swept.records).notes,
              ElementsAre("points, noise: holds at 1, 2; not run: 3"));
  swept.records[0] = {{"name", "noise-1"}, {"status", "outdated"}, {"reason", "changed"}};
  swept.study.plots[0].limit = 0.5;
  EXPECT_THAT(studyTable(swept.study, swept.records).notes,
              ElementsAre("noise-1: changed", "points, noise: breaks at 2; not run: 1, 3"));
  swept.records[1] = FactSheet::Json();
  EXPECT_TRUE(breaksOf(swept.study, swept.records).empty()) << "nothing is known";
}

TEST(StudyTable, HasARowACaseAndNoEmptyColumns) {
  Swept swept;
  swept.study.cases[0].beside["paper [mm]"] = 0.46;
  const StudyTable table = studyTable(swept.study, swept.records);
  EXPECT_THAT(table.headings, ElementsAre("case", "paper [mm]", "frames fused [share]",
                                          "material points mean [mm]", "status"));
  EXPECT_THAT(table.rows[0], ElementsAre("noise-1", "0.46", "1.00", "0.100", "done"));
  EXPECT_THAT(table.rows[2], ElementsAre("noise-3", "", "", "", "failed"));
  EXPECT_THAT(table.notes, ElementsAre("noise-3: it, broke", "points, noise: breaks at 2"));
  EXPECT_THAT(table.markdown(), HasSubstr("| noise-2 |  | 1.00 | 0.700 | done |\n"));
  EXPECT_THAT(table.csv(), HasSubstr("\nnoise-3,,,,failed\n"));
}

TEST(StudyTable, AMetricThatNoCaseHasIsWarnedOf) {
  Swept swept;
  swept.study.columns = {{"evaluation.tracks.mean_mmm", "points", 3}, {"run.fused_share", "f", 2}};
  swept.study.plots[0].metric.path = "evaluation.trakcs.mean_mm";
  swept.study.plots[0].p95_path = "evaluation.tracks.p95_mm";
  swept.records[0]["evaluation"]["tracks"]["p95_mm"] = nullptr;
  const std::vector<std::string> expected{
      "column: no case has a value of `evaluation.tracks.mean_mmm` (did you mean "
      "`evaluation.tracks.mean_mm`?)",
      "plot points: no case has a value of `evaluation.trakcs.mean_mm` (did you mean "
      "`evaluation.tracks.mean_mm`?); every level counts as broken",
      "plot points: no case has a value of `evaluation.tracks.p95_mm`"};
  EXPECT_EQ(metricWarnings(swept.study, swept.records), expected);
  EXPECT_THAT(studyTable(swept.study, swept.records).notes, testing::IsSupersetOf(expected));
  for (FactSheet::Json& record : swept.records) record = FactSheet::Json();
  EXPECT_TRUE(metricWarnings(swept.study, swept.records).empty()) << "no case is done";
  const Swept spelt;
  EXPECT_TRUE(metricWarnings(spelt.study, spelt.records).empty());
}

TEST(StudyTable, CellsThatWouldBreakACsvAreQuoted) {
  StudyTable table;
  table.headings = {"a, \"b\""};
  EXPECT_EQ(table.csv(), "\"a, \"\"b\"\"\"\n");
}

TEST(StudyPage, HoldsTheFiguresAndEscapesTexts) {
  const Swept swept;
  const FactSheet::Json record =
      studyJson(swept.study, swept.records, "softscope study s.toml --out s");
  const auto figures = studyFigures(swept.study, swept.records);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].first, "noise_points");
  const std::string page =
      studyPage(swept.study, studyTable(swept.study, swept.records), figures, record);
  EXPECT_THAT(page, HasSubstr("<h1>Noise &amp; &lt;blur&gt;</h1>"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, testing::Not(HasSubstr("<?xml")));
  EXPECT_THAT(page, HasSubstr("not for diagnosis"));
}

}  // namespace
}  // namespace softscope::test
