// tests/toolkit/run_figures_test.cpp: figures of runs: moments, series, two runs.
#include <gmock/gmock.h>

#include <functional>

#include "support/made_run.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/records.h"
#include "toolkit/figures/draw_figure.h"
#include "toolkit/figures/figure_outputs.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunFigures : public WallTest {
 protected:
  /// Of the run, to a file in the folder.
  FigureRequest figure(const std::string& out, const std::string& kind = "four") const {
    FigureRequest request;
    request.run = at("run");
    request.kind = kind;
    request.page.out = {at(out)};
    request.page.dots_per_inch = 100;
    request.page.force = true;
    return request;
  }
  FigureRequest withTruth(const std::string& out, const std::string& kind = "four") const {
    FigureRequest request = figure(out, kind);
    request.reference = at("truth");
    return request;
  }
  static Json drawn(const FigureRequest& request) {
    const DrawnFigure figure = drawFigure(request);
    writeFigure(figure.drawing, request.page, figure.record);
    return written(figure.record);
  }
  static void expectRefused(const FigureRequest& request, const std::vector<std::string>& parts) {
    expectError<OptionError>([&] { drawFigure(request); }, parts);
  }
};

TEST_F(RunFigures, TheModelIsShownBesideTheTruthInItsCamera) {
  const Json record = drawn(withTruth("a.svg"));
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
  EXPECT_THAT(svg, HasSubstr("Model and scan of frame 5, 0.20 s, in the view of the scope."));
  EXPECT_THAT(svg, testing::Not(HasSubstr("stroke-linecap=\"round\"")))
      << "a model is cut as a surface, to lines: no dots";

  FigureRequest seen = withTruth("b.svg");
  seen.observed_only = true;
  seen.frame = 2;
  EXPECT_NEAR(drawn(seen)["errors"]["distance"]["max_mm"], 0.14, kFloats);
  EXPECT_THAT(textOf(at("b.svg")), HasSubstr(">not observed<"));
}

TEST_F(RunFigures, WhatCantBeShownIsTold) {
  FigureRequest wrong = withTruth("a.svg");
  wrong.frame = 77;
  expectRefused(wrong, {"`frame=` is 77"});
  wrong = withTruth("a.svg");
  wrong.test = at("run/model.ply");
  expectRefused(wrong, {});
  fs::remove_all(at("run/models"));
  expectError<InputError>([&] { drawFigure(withTruth("a.svg")); }, {"no frame has both"});
}

TEST_F(RunFigures, FramesStandSideBySide) {
  FigureRequest request = figure("f.svg", "frames");
  request.frames = {0, 2, 5};
  const Json record = drawn(request);
  EXPECT_EQ(record["frames"], (Json{0, 2, 5}));
  EXPECT_EQ(record["inputs"].size(), 3u);
  EXPECT_THAT(textOf(at("f.svg")), HasSubstr(">(c) frame 5, 0.20 s<"));
}

TEST_F(RunFigures, ASeriesHasOneRangeAndEveryFrame) {
  FigureRequest request = withTruth("s.svg", "series");
  request.observed_only = true;
  const Json series = drawn(request);
  EXPECT_EQ(series["frames"].size(), 4u) << "evenly spread";
  EXPECT_EQ(series["errors"][3]["range_mm"], series["errors"][0]["range_mm"]) << "one range";
  EXPECT_NEAR(series["errors"][3]["distance"]["max_mm"], 0.2, kFloats);
  EXPECT_LT(series["errors"][0]["distance"]["mean_mm"], series["errors"][3]["distance"]["mean_mm"])
      << "the made run gets worse by 0.02 mm a frame";
  for (const char* word : {">up to P95<", ">time [s]<", ">not observed<", ">(a) frame 0, 0.00 s<",
                           ">(d) frame 5, 0.20 s<", ">(e) all evaluated frames<"})
    EXPECT_THAT(textOf(at("s.svg")), HasSubstr(word));
}

TEST_F(RunFigures, TwoRunsHaveErrorMapsWithOneRange) {
  makeWallRun(at("later"), kFrames, 1);
  FigureRequest request = withTruth("c.svg", "compare");
  request.other = at("later");
  EXPECT_EQ(drawn(request)["errors"].size(), 2u);
  for (const char* word : {">(a) run<", ">(b) later<", ">(d) later, errors<"})
    EXPECT_THAT(textOf(at("c.svg")), HasSubstr(word));
}

TEST_F(RunFigures, WhatAKindLacksIsRefused) {
  expectRefused(figure("w.svg", "film"), {"film"});
  expectRefused(figure("w.svg", "series"), {});
  expectRefused(figure("w.svg", "compare"), {});
  FigureRequest wrong = figure("w.svg", "frames");
  wrong.frames = {0, 99};
  expectRefused(wrong, {"99"});
  wrong = figure("w.svg");
  wrong.frames = {0};
  expectRefused(wrong, {"frames"});
}

TEST_F(RunFigures, TwoRunsAreToldApartAndShownAtTheSameFrame) {
  makeWallRun(at("paper/run"), 3);
  makeWallRun(at("ours/run"), kFrames);
  FigureRequest request = figure("c.svg", "compare");
  request.page.dots_per_inch = 50;
  request.run = at("paper/run");
  request.other = at("ours/run");
  EXPECT_EQ(drawn(request)["frame"], 2) << "the last one of the shorter run";
  for (const char* word :
       {">(a) paper<", ">(b) ours<",
        ">Two reconstructions, each at frame 2, 0.08 s; common viewpoint and scale.<"})
    EXPECT_THAT(textOf(at("c.svg")), HasSubstr(word));
  // What run.json says of the images tells whether both are of one clip.
  const auto clip = [&](const char* file, const char* hash) {
    write(file, std::string(R"({"inputs":{"left":{"sha256":")") + hash + R"("}}})");
  };
  clip("paper/run/run.json", "1a");
  clip("ours/run/run.json", "1a");
  drawn(request);
  EXPECT_THAT(textOf(at("c.svg")), HasSubstr(">Two reconstructions of one clip, each at frame 2,"));
  clip("ours/run/run.json", "2b");
  drawn(request);
  EXPECT_THAT(
      textOf(at("c.svg")),
      HasSubstr(
          ">Two reconstructions of two clips, each at frame 2, 0.08 s of its own; common scale.<"));
  fs::remove(at("paper/run/run.json"));
  fs::remove(at("ours/run/run.json"));
  request.reference = at("truth");
  EXPECT_EQ(drawn(request)["frame"], 2);
  EXPECT_THAT(textOf(at("c.svg")), HasSubstr(">(c) paper, errors<"));
  FigureRequest named = request;
  named.names = {"with matches"};
  expectRefused(named, {"name"});  // and the other one?
  named.names.push_back("without");
  drawn(named);
  EXPECT_THAT(textOf(at("c.svg")), HasSubstr(">(d) without, errors<"));
  request.frames = {0, 1};
  expectRefused(request, {"frames"});  // which one?
  request.frames = {5};
  expectRefused(request, {"the last one that both runs have is 2"});
}

}  // namespace
}  // namespace softscope::test
