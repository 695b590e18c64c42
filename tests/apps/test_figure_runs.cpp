// tests/apps/test_figure_runs.cpp: `softscope figure RUN`: moments, series, two runs.
#include <cmath>

#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunFigure : public Evaluate {
 protected:
  Outcome figure(std::vector<std::string> more) const {
    more.insert(more.begin(), {"figure", at("run"), "--reference", at("truth")});
    return softscope::test::run(more);
  }
};

TEST_F(RunFigure, TheModelIsShownBesideTheTruthInItsCamera) {
  const Outcome all = figure({"--out", at("a.svg"), "--dpi", "100", "--json"});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  const Json record = all.json();
  EXPECT_EQ(record["frame"], kFrames - 1);
  EXPECT_NEAR(record["errors"]["distance"]["max_mm"], 0.4, kFloats) << "unseen, last frame";
  EXPECT_EQ(record["errors"]["range_mm"][1], 0.5);
  EXPECT_EQ(record["views"][0]["name"], "from the scope");
  // The wall is 50 mm away and 2.5 nearer by then; seen points lie 0.2 mm before it.
  EXPECT_NEAR(record["surfaces"][0]["low_mm"][2], 47.5, 1e-3);
  EXPECT_NEAR(record["surfaces"][2]["high_mm"][2], 47.3, 1e-3);
  const std::string svg = textOf(at("a.svg"));
  for (const char* word : {">true surface<", ">model<", ">scan of this frame<", ">near<", ">far<"})
    EXPECT_THAT(svg, HasSubstr(word));
  EXPECT_THAT(svg, testing::Not(HasSubstr(">R<"))) << "a scope's scene has no patient's sides";
  EXPECT_THAT(svg, HasSubstr("Model and scan of frame 5, 0.20 s, as the scope sees them."));
  EXPECT_THAT(svg, testing::Not(HasSubstr("stroke-linecap=\"round\"")))
      << "a model is cut as a surface, to lines: no dots";

  const Outcome seen =
      figure({"--out", at("b.svg"), "--dpi", "100", "--observed", "--frame", "2", "--json"});
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_NEAR(seen.json()["errors"]["distance"]["max_mm"], 0.14, kFloats);
  EXPECT_THAT(textOf(at("b.svg")), HasSubstr(">not observed<"));
}

TEST_F(RunFigure, WhatCantBeShownIsTold) {
  const Outcome frame = figure({"--out", at("a.svg"), "--frame", "77"});
  EXPECT_EQ(frame.exit_code, 2);
  EXPECT_THAT(frame.err, HasSubstr("--frame is 77"));
  EXPECT_EQ(figure({"--out", at("a.svg"), "--test", at("run/model.ply")}).exit_code, 2);
  fs::remove_all(at("run/models"));
  expectRefused({"no frame has both"}, figure({"--out", at("a.svg")}));
}

TEST_F(RunFigure, WholeRunsHaveFiguresToo) {
  const auto kind = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"figure", at("run"), "--dpi", "100", "--force", "--json"});
    const Outcome outcome = softscope::test::run(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? outcome.json() : Json();
  };
  const Json frames = kind({"--kind", "frames", "--frames", "0,2,5", "--out", at("f.svg")});
  EXPECT_EQ(frames["frames"], (Json{0, 2, 5}));
  EXPECT_EQ(frames["inputs"].size(), 3u);
  EXPECT_THAT(textOf(at("f.svg")), HasSubstr(">(c) frame 5, 0.20 s<"));

  const Json series =
      kind({"--kind", "series", "--reference", at("truth"), "--observed", "--out", at("s.svg")});
  EXPECT_EQ(series["frames"].size(), 4u) << "evenly spread";
  EXPECT_EQ(series["errors"][3]["range_mm"], series["errors"][0]["range_mm"]) << "one range";
  EXPECT_NEAR(series["errors"][3]["distance"]["max_mm"], 0.2, kFloats);
  for (const char* word : {">up to P95<", ">time [s]<", ">not observed<", ">(a) frame 0, 0.00 s<",
                           ">(d) frame 5, 0.20 s<", ">(e) every judged frame<"})
    EXPECT_THAT(textOf(at("s.svg")), HasSubstr(word));

  makeWallRun(at("later"), kFrames, 1);
  const Json two = kind({"--kind", "compare", "--other", at("later"), "--reference", at("truth"),
                         "--out", at("c.svg")});
  EXPECT_EQ(two["errors"].size(), 2u);
  for (const char* word : {">(a) run<", ">(b) later<", ">(d) later, errors<"})
    EXPECT_THAT(textOf(at("c.svg")), HasSubstr(word));
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--kind", "film"},
                                             {"--kind", "series"},
                                             {"--kind", "compare"},
                                             {"--kind", "frames", "--frames", "0,99"},
                                             {"--kind", "frames", "--frames", "1.5"},
                                             {"--frames", "0"}}) {
    std::vector<std::string> line{"figure", at("run"), "--out", at("w.svg")};
    line.insert(line.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(softscope::test::run(line).exit_code, 2) << wrong.back();
  }
}

TEST_F(RunFigure, FramesInAnyOrderStandBesideTheirOwnErrors) {
  const auto series = [&](const std::string& frames) {
    return softscope::test::run({"figure", at("run"), "--kind", "series", "--reference",
                                 at("truth"), "--frames", frames, "--out", at("s.svg"), "--dpi",
                                 "50", "--force", "--json"});
  };
  const Json rising = series("0,4").json(), falling = series("4,0").json();
  EXPECT_EQ(falling["frames"], (Json{0, 4}));
  EXPECT_EQ(falling["errors"], rising["errors"]);
  EXPECT_LT(falling["errors"][0]["distance"]["mean_mm"],
            falling["errors"][1]["distance"]["mean_mm"])
      << "the made run gets worse by 0.02 mm a frame";
  EXPECT_EQ(series("4,4").exit_code, 2);
}

TEST_F(RunFigure, TwoRunsAreToldApartAndShownAtTheSameFrame) {
  makeWallRun(at("paper/run"), 3);
  makeWallRun(at("ours/run"), kFrames);
  std::vector<std::string> line{"figure",       at("paper/run"), "--kind",    "compare", "--other",
                                at("ours/run"), "--out",         at("c.svg"), "--dpi",   "50",
                                "--force",      "--json"};
  const Json coloured = softscope::test::run(line).json();
  EXPECT_EQ(coloured["frame"], 2) << "the last one of the shorter run";
  for (const char* word :
       {">(a) paper<", ">(b) ours<",
        ">Two reconstructions, each at frame 2, 0.08 s; one place and one scale.<"})
    EXPECT_THAT(textOf(at("c.svg")), HasSubstr(word));
  // What run.json says of the images tells whether both are of one clip.
  const auto clip = [&](const char* file, const char* hash) {
    write(file, std::string(R"({"inputs":{"left":{"sha256":")") + hash + R"("}}})");
  };
  clip("paper/run/run.json", "1a");
  clip("ours/run/run.json", "1a");
  softscope::test::run(line);
  EXPECT_THAT(textOf(at("c.svg")), HasSubstr(">Two reconstructions of one clip, each at frame 2,"));
  clip("ours/run/run.json", "2b");
  softscope::test::run(line);
  EXPECT_THAT(
      textOf(at("c.svg")),
      HasSubstr(
          ">Two reconstructions of two clips, each at frame 2, 0.08 s of its own; one scale.<"));
  fs::remove(at("paper/run/run.json"));
  fs::remove(at("ours/run/run.json"));
  line.insert(line.end(), {"--reference", at("truth")});
  EXPECT_EQ(softscope::test::run(line).json()["frame"], 2);
  std::vector<std::string> named = line;
  named.insert(named.end(), {"--name", "with matches"});
  EXPECT_EQ(softscope::test::run(named).exit_code, 2) << "and the other one?";
  named.insert(named.end(), {"--name", "without"});
  EXPECT_EQ(softscope::test::run(named).exit_code, 0);
  EXPECT_THAT(textOf(at("c.svg")), HasSubstr(">(d) without, errors<"));
  softscope::test::run(line);
  EXPECT_THAT(textOf(at("c.svg")), HasSubstr(">(c) paper, errors<"));
  line.insert(line.end(), {"--frames", "0,1"});
  EXPECT_EQ(softscope::test::run(line).exit_code, 2) << "which one?";
  line.back() = "5";
  const Outcome beyond = softscope::test::run(line);
  EXPECT_EQ(beyond.exit_code, 2);
  EXPECT_THAT(beyond.err, HasSubstr("the last one that both runs have is 2"));
}

}  // namespace
}  // namespace softscope::test
