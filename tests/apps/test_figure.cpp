// tests/apps/test_figure.cpp: `softscope figure` and `softscope slice`: options, lines, exit codes.
#include <algorithm>

#include "support/made_meshes.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Figure : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("ct.mha", ctMha());
    write("reference.obj", boxObj({-20, -10, -8}, {20, 10, 8}, "# SPACE=LPS\n"));
    write("away.obj", boxObj({-17, -10, -8}, {23, 10, 8}));  // 3 mm to the left
  }
  Outcome figure(std::vector<std::string> more) const {
    more.insert(more.begin(), "figure");
    return run(more);
  }
  Outcome slice(std::vector<std::string> more) const {
    more.insert(more.begin(), "slice");
    return run(more);
  }
};

TEST_F(Figure, OptionsReachTheFigureAndItsFilesAreTold) {
  const Outcome outcome = figure({"--ct",     at("ct.mha"),   "--reference", at("reference.obj"),
                                  "--test",   at("away.obj"), "--align",     "icp",
                                  "--errors", "signed",       "--range-mm",  "1",
                                  "--eye",    "0,0,1",        "--columns",   "2",
                                  "--dpi",    "60",           "--out",       at("f.svg"),
                                  "--out",    at("f.png"),    "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("written: " + at("f.svg") + ", " + at("f.png") + ", " + at("f.json")));
  const Json record = outcome.json();
  EXPECT_EQ(record, Json::parse(textOf(at("f.json"))));
  EXPECT_EQ(record["alignment"]["method"], "icp");
  EXPECT_EQ(record["errors"]["range_mm"], (Json{-1.0, 1.0}));
  EXPECT_EQ(textOf(at("f.png")).substr(1, 3), "PNG");
}

TEST_F(Figure, WarningsAreOnStandardError) {
  write("far.obj", boxObj({500, 0, 0}, {520, 10, 8}));
  const Outcome outcome = figure(
      {"--ct", at("ct.mha"), "--reference", at("far.obj"), "--dpi", "60", "--out", at("far.svg")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("mm outside of the volume"));
}

TEST_F(Figure, BadInputEndsInOneLine) {
  const auto oneLine = [](const Outcome& outcome, int code) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  oneLine(figure({"--ct", at("none"), "--out", at("x.png")}), 3);
  const std::vector<std::string> good{"--reference", at("reference.obj"), "--dpi", "60",
                                      "--out",       at("x.png")};
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--style", "iee"},
                                             {"--width-mm", "3"},
                                             {"--at", "1,2"},
                                             {"--errors", "some"},
                                             {"--columns", "3"},
                                             {"--out", at("x.jpg")},
                                             {"--ct", at("ct.mha"), "--window", "bones"},
                                             {"--eye", "0,0,0"},
                                             {"--eye", "0,0"},
                                             {"--align", "icp"},
                                             {"--align", "landmarks"}}) {
    std::vector<std::string> line = good;
    line.insert(line.end(), wrong.begin(), wrong.end());
    oneLine(figure(line), 2);
  }
  oneLine(figure({"--reference", at("reference.obj"), "--dpi", "-1", "--out", at("x.png")}), 2);
  oneLine(figure({"--out", at("x.png")}), 2);
  EXPECT_FALSE(fs::exists(at("x.png"))) << "nothing half-made";
  EXPECT_EQ(figure(good).exit_code, 0);
  oneLine(figure(good), 2);  // it is there now
}

TEST_F(Figure, OptionsReachTheSlices) {
  const Outcome outcome =
      slice({at("ct.mha"), "--reference", at("reference.obj"), "--surface", at("away.obj"),
             "--plane", "oblique", "--normal", "0,1,1", "--positions", "0,2", "--at", "1,2,3",
             "--neurological", "--dpi", "60", "--out", at("o.svg"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["views"][1]["name"], "oblique, +2.0 mm");
  EXPECT_EQ(outcome.json()["sides"], "neurological");
  EXPECT_THAT(textOf(at("o.svg")), HasSubstr(">reference<"));
  EXPECT_THAT(slice({at("ct.mha"), "--landmarks", write("p.csv", "name,x_mm,y_mm,z_mm\na,1,2,3\n"),
                     "--out", at("l.svg")})
                  .err,
              HasSubstr("needs --at"));
}

TEST_F(Figure, BadLinesOfSlicesAreRefused) {
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--plane", "axiall"},
                                             {"--plane", "axial", "--positions", "1:2"},
                                             {"--columns", "-1"}}) {
    std::vector<std::string> line{at("ct.mha"), "--out", at("x.svg")};
    line.insert(line.end(), wrong.begin(), wrong.end());
    const Outcome outcome = slice(line);
    EXPECT_EQ(outcome.exit_code, 2) << wrong[1] << outcome.err;
    EXPECT_FALSE(fs::exists(at("x.svg")));
  }
  EXPECT_EQ(slice({"--out", at("y.svg")}).exit_code, 2) << "nothing to slice";
}

class RunFigure : public Evaluate {
 protected:
  Outcome figure(std::vector<std::string> more) const {
    more.insert(more.begin(), {"figure", at("run"), "--dpi", "50", "--force", "--json"});
    return run(more);
  }
};

TEST_F(RunFigure, FramesInAnyOrderStandBesideTheirOwnErrors) {
  const auto series = [&](const std::string& frames) {
    return figure(
        {"--kind", "series", "--reference", at("truth"), "--frames", frames, "--out", at("s.svg")});
  };
  const Json rising = series("0,4").json(), falling = series("4,0").json();
  EXPECT_EQ(falling["frames"], (Json{0, 4}));
  EXPECT_EQ(falling["errors"], rising["errors"]);
  EXPECT_LT(falling["errors"][0]["distance"]["mean_mm"],
            falling["errors"][1]["distance"]["mean_mm"])
      << "the made run gets worse by 0.02 mm a frame";
  EXPECT_EQ(series("4,4").exit_code, 2);
}

TEST_F(RunFigure, OptionsReachTheFigure) {
  makeWallRun(at("later"), kFrames, 1);
  const Outcome two = figure({"--kind", "compare", "--other", at("later"), "--name", "one",
                              "--name", "two", "--out", at("c.svg")});
  ASSERT_EQ(two.exit_code, 0) << two.err;
  for (const char* word : {">(a) one<", ">(b) two<"})
    EXPECT_THAT(textOf(at("c.svg")), HasSubstr(word));
  const Outcome seen =
      figure({"--reference", at("truth"), "--observed", "--frame", "2", "--out", at("b.svg")});
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_NEAR(seen.json()["errors"]["distance"]["max_mm"], 0.14, kFloats);
}

TEST_F(RunFigure, WhatCantBeShownIsTold) {
  const Outcome frame = figure({"--reference", at("truth"), "--out", at("a.svg"), "--frame", "77"});
  EXPECT_EQ(frame.exit_code, 2);
  EXPECT_THAT(frame.err, HasSubstr("--frame is 77"));
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"--kind", "film"}, {"--kind", "frames", "--frames", "1.5"}, {"--kind", "compare"}}) {
    std::vector<std::string> line = wrong;
    line.insert(line.end(), {"--out", at("w.svg")});
    EXPECT_EQ(figure(line).exit_code, 2) << wrong.back();
  }
  fs::remove_all(at("run/models"));
  const Outcome none = run({"figure", at("run"), "--reference", at("truth"), "--out", at("a.svg")});
  expectRefused({"no frame has both"}, none);
}

}  // namespace
}  // namespace softscope::test
