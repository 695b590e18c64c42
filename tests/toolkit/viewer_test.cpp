// tests/toolkit/viewer_test.cpp: screenshots and movies of runs, without a display.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "io/files/file_lock.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "io/sequences/picture_source.h"
#include "tests/toolkit/evaluation_fixture.h"
#include "tests/toolkit/made_sequences.h"
#include "toolkit/viewer/show_run.h"
#include "vtk_views/scenes/render_check.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

int countNear(const ColourImage& picture, Rgb8 colour, int by) {
  return static_cast<int>(
      std::count_if(picture.values.begin(), picture.values.end(), [&](const Rgb8& c) {
        return std::abs(c.red - colour.red) <= by && std::abs(c.green - colour.green) <= by &&
               std::abs(c.blue - colour.blue) <= by;
      }));
}

constexpr Rgb8 kWall{200, 100, 90};  // what made_run.cpp paints it

/// A moving wall of 80 x 80 mm: six models and their truth.
class Viewer : public Evaluation {
 protected:
  /// A screenshot, view.png.
  ViewRequest screenshot() const {
    ViewRequest request;
    request.run.run = at("run");
    request.screenshot = at("view.png");
    request.size = "480x360";
    request.overwrite = true;
    return request;
  }
  /// A movie, view.mp4.
  ViewRequest movie(const std::string& size) const {
    ViewRequest request;
    request.run.run = at("run");
    request.movie.file = at("view.mp4");
    request.size = size;
    return request;
  }
  /// The files that it asks for, what was warned of among `told`.
  static Json show(const ViewRequest& request, Told* told = nullptr) {
    request.validate();
    RunSource source(request.run);
    if (told != nullptr) told->warnings = viewWarnings(request, source);
    return written(writeView(request, source).record);
  }
  ColourImage picture(const ViewRequest& request) const {
    show(request);
    return readColourImage(request.screenshot);
  }
  std::vector<std::string> warningsOf(const ViewRequest& request) const {
    Told told;
    show(request, &told);
    return told.warnings;
  }
  void SetUp() override {
    Evaluation::SetUp();
    static const bool renders = checkRendering().works;
    if (!renders) GTEST_SKIP() << "nothing renders on this machine";
  }
};

TEST_F(Viewer, ACleanPictureIsTheViewAlone) {
  ViewRequest request = screenshot();
  request.look = "scope";
  const ColourImage with_slider = picture(request);
  request.movie.clean = true;
  const ColourImage clean = picture(request);
  ASSERT_EQ(clean.height_px, 360);
  EXPECT_EQ(countNear(clean, {0, 110, 170}, 8), 0) << "the slider's blue";
  EXPECT_GT(countNear(with_slider, {0, 110, 170}, 8), 20);
  int wall = 0;  // where the foot would be
  for (int v = 272; v < 360; ++v)
    for (int u = 0; u < 480; ++u) wall += std::abs(clean.at(u, v).green - kWall.green) < 40;
  EXPECT_GT(wall, 480 * 88 / 10) << "the wall's dots, with gaps between them: 14 % of the pixels";
  request.screenshot.clear();
  expectError<OptionError>([&] { request.validate(); }, {"`clean=`"});  // a window keeps its slider
}

TEST_F(Viewer, LettersKeepTheirShareOfALargePicture) {
  const auto blueRows = [&](const char* size) {  // of the slider, left of its knob
    ViewRequest request = screenshot();
    request.size = size;
    const ColourImage shown = picture(request);
    int rows = 0;
    for (int v = shown.height_px - shown.height_px / 6; v < shown.height_px; ++v) {
      const Rgb8 c = shown.at(shown.width_px / 2, v);
      rows += c.red < 60 && std::abs(c.blue - 170) < 60;
    }
    return rows;
  };
  const int usual = blueRows("960x720");
  EXPECT_GE(usual, 2);
  EXPECT_GT(blueRows("1920x1440"), usual + 1) << "a line of 3 px becomes one of 6";
}

TEST_F(Viewer, AScreenshotShowsTheTissueWithoutADisplay) {
  const ColourImage shown = picture(screenshot());
  EXPECT_EQ(shown.width_px, 480);
  EXPECT_EQ(shown.height_px, 360);
  EXPECT_GT(countNear(shown, kWall, 3), 10000);
  EXPECT_GT(countNear(shown, {255, 255, 255}, 0), 10000) << "figures are on white";
  ViewRequest of_frame = screenshot();
  of_frame.frame = 3;
  EXPECT_EQ(show(of_frame)["screenshot"]["frame"], 3);
  of_frame.overwrite = false;
  expectError<OptionError>([&] { show(of_frame); }, {"view.png"});  // it is there already
}

TEST_F(Viewer, ErrorsComeFromTheTruthOrFromAnEvaluation) {
  ViewRequest request = screenshot();
  request.colour = "errors";
  request.run.reference = at("truth");
  EXPECT_EQ(countNear(picture(request), kWall, 3), 0);
  request.run.errors.range_mm = 0.5;
  const ColourImage again = picture(request);
  evaluateInto("evaluation");
  request.run.evaluation = at("evaluation");
  const ColourImage read = picture(request);
  // The wall has 6561 points, fewer than a map keeps: both show the same errors, to rounding.
  int different = 0;
  for (std::size_t i = 0; i < read.size(); ++i)
    different += std::abs(read.values[i].green - again.values[i].green) > 3;
  EXPECT_LT(different, 200);
}

TEST_F(Viewer, ARunOfOtherImagesIsWarnedOf) {
  ViewRequest request = screenshot();
  request.run.reference = at("truth");
  EXPECT_THAT(warningsOf(request), Not(Contains(HasSubstr("other images"))));
  writeSequence(at("images"), 2);
  for (const char* side : {"left", "right"})
    fs::copy(at("images") + "/" + side, at("truth") + "/" + side);
  write("run/run.json", R"({"inputs": {"left": {"sha256": "00"}}})");
  EXPECT_THAT(warningsOf(request),
              Contains(at("truth/left") + ": the run was made from other images; a run of "
                                          "another sequence?"));
}

TEST_F(Viewer, AnEvaluationOfAnotherRunIsRefused) {
  evaluateInto("evaluation");
  fs::copy_file(at("run/models/000001.ply"), at("run/models/000005.ply"),
                fs::copy_options::overwrite_existing);
  ViewRequest request = screenshot();
  request.colour = "errors";
  request.run.evaluation = at("evaluation");
  expectError<InputError>([&] { show(request); }, {"000005.vtp", "evaluate the run again"});
  request = screenshot();
  request.run.evaluation = at("truth");
  expectError<InputError>([&] { show(request); }, {"errors/NNNNNN.vtp"});
}

TEST_F(Viewer, AMovieHasItsFramesSizeAndMotion) {
  ViewRequest request = movie("400x300");
  request.movie.frames_per_second = 10;
  request.movie.seconds = 1.2;
  request.movie.turn_deg = 60;
  std::vector<int> counted;
  WorkListener listener;
  listener.progress = [&](int done, int total) {
    EXPECT_EQ(total, 12);
    counted.push_back(done);
    return true;
  };
  request.validate();
  RunSource source(request.run);
  EXPECT_EQ(written(writeView(request, source, listener).record)["movie"]["frames"], 12);
  EXPECT_EQ(counted.back(), 12);
  const auto pictures = openPictures(at("view.mp4"));
  ASSERT_EQ(pictures->count(), 12);
  const ColourImage first = pictures->read(0), last = pictures->read(11);
  EXPECT_EQ(first.width_px, 400);
  EXPECT_EQ(first.height_px, 300);
  EXPECT_GT(countNear(first, kWall, 25), 5000);  // what a codec leaves of it
  int different = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    different += std::abs(first.values[i].green - last.values[i].green) > 40;
  EXPECT_GT(different, 2000);
}

TEST_F(Viewer, AMovieOfTheClipLastsAsLongAsTheClip) {
  // Six frames of 0.04 s each, half as fast.
  ViewRequest request = movie("320x240");
  request.movie.speed = 0.5;
  request.movie.frames_per_second = 25;
  EXPECT_EQ(show(request)["movie"]["frames"], 12);
}

TEST_F(Viewer, ARunWhoseWriterIsGoneIsCalledStopped) {
  {
    const FileLock writer(at("run/writing.lock"));
    ASSERT_TRUE(writer.tryToHold());
    EXPECT_THAT(warningsOf(screenshot()), Not(Contains(HasSubstr("stopped"))));
  }
  EXPECT_THAT(warningsOf(screenshot()), Contains(HasSubstr("stopped before its end")));
  write("run/run.json", "{}");
  EXPECT_THAT(warningsOf(screenshot()), Not(Contains(HasSubstr("stopped"))));
}

TEST_F(Viewer, TheLastModelAloneCanBeSeen) {
  fs::remove_all(at("run/models"));
  EXPECT_GT(countNear(picture(screenshot()), kWall, 3), 10000);
}

TEST_F(Viewer, BadRunsAreRefused) {
  const auto refused = [&](const std::string& name, const std::vector<std::string>& parts) {
    ViewRequest request = screenshot();
    request.run.run = at(name);
    expectError<InputError>([&] { show(request); }, parts);
  };
  refused("nowhere", {"nowhere"});
  fs::create_directories(at("empty"));
  refused("empty", {"empty", "contains no model", "`wait=`"});
  const std::string whole = textOf(at("run/models/000005.ply"));
  fs::remove(at("run/models/000005.ply"));
  write("run/models/000005.ply", whole.substr(0, whole.size() / 2));
  refused("run", {"000005.ply"});
}

TEST_F(Viewer, WrongOptionsAreNamed) {
  const auto wrong = [&](const std::function<void(ViewRequest&)>& change, const std::string& part) {
    ViewRequest request = screenshot();
    change(request);
    expectError<OptionError>([&] { show(request); }, {part});
  };
  wrong([](ViewRequest& request) { request.colour = "errors"; }, "`reference=` or `evaluation=`");
  wrong([](ViewRequest& request) { request.colour = "blue"; }, "texture, errors, weights");
  wrong([](ViewRequest& request) { request.look = "sideways"; }, "free, scope, front");
  wrong([](ViewRequest& request) { request.screenshot = "view.jpg"; }, "must end in .png");
  wrong([](ViewRequest& request) { request.frame = 99; }, "frames 0 to 5");
  wrong([](ViewRequest& request) { request.movie.turn_deg = 1e9; }, "`turn_deg=`");
  wrong([](ViewRequest& request) { request.size = "10x10"; }, "size");
  expectError<OptionError>([&] { show(movie("401x300")); }, {"size"});
}

TEST_F(Viewer, AMotionIntoTheCtMustBeRigid) {
  ViewRequest request = screenshot();
  request.run.reference = at("truth/groundtruth/mesh/000000.ply");
  request.run.ct_from_run = write("m.txt", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  expectError<InputError>([&] { show(request); }, {"m.txt", "rigid transform"});
}

class SavedRun : public InFolder {};

TEST_F(SavedRun, AModelOfARunTellsItsMomentAndItsNodes) {
  simulateClip(at("clip"), 3);
  ReconstructOptions options = reconstruction(at("clip"), at("run"));
  options.save_every = 1;
  reconstructSequence(options);
  const std::string head = textOf(at("run/models/000002.ply")).substr(0, 600);
  EXPECT_THAT(head, HasSubstr("comment world_from_left "));
  EXPECT_THAT(head, HasSubstr("comment left_camera 160 120 "));
  EXPECT_THAT(textOf(at("run/nodes/000002.csv")), HasSubstr("node,x_mm,y_mm,z_mm\n0,"));
  fs::remove(at("run/run.json"));  // as while it goes on: then no table is needed either
  fs::remove(at("run/trajectory.txt"));
  fs::remove(at("run/frames.csv"));
  ViewRequest request;
  request.run.run = at("run");
  request.nodes = request.arrows = true;
  request.look = "scope";
  request.screenshot = at("view.png");
  RunSource source(request.run);
  EXPECT_THAT(viewWarnings(request, source), testing::IsEmpty()) << "nodes and camera are known";
  if (!checkRendering().works) return;
  writeView(request, source);
  EXPECT_FALSE(readColourImage(at("view.png")).empty());
}

}  // namespace
}  // namespace softscope::test
