// tests/apps/test_dataset_layouts.cpp: simulated clips as data sets ship them, read, run and
// judged.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "io/calibrations/calibration_reader.h"
#include "io/datasets/stir_files.h"
#include "io/datasets/surgt_files.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/trajectory_file.h"
#include "io/geometry/xyz_files.h"
#include "io/sequences/dataset_form.h"
#include "stereo/rectification/rectifier.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DatasetLayouts : public InFolder {
 protected:
  Outcome simulate(const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> words{"simulate", "--out",   at(out), "--size",
                                   "240x180",  "--quiet", "--set", "instrument.radius_mm=2"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(DatasetLayouts, StirClipsAreRecognisedRunAndJudgedAsOurOwn) {
  ASSERT_EQ(simulate("data/seq_1", {"--layout", "stir2026", "--frames", "6"}).exit_code, 0);
  const Outcome own =
      simulate("own", {"--set", "pictures=mp4", "--set", "masks=false", "--frames", "6"});
  ASSERT_EQ(own.exit_code, 0) << own.err;
  for (const char* name : {"left.mp4", "right.mp4"})  // an encoder's bytes depend on its threads
    fs::copy_file(at("data/seq_1/") + name, at("own/") + name,
                  fs::copy_options::overwrite_existing);

  const Outcome info = run({"info", at("data/seq_1"), "--json"});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(info.json()["dataset"], "STIR 2026");
  EXPECT_EQ(info.json()["dataset_truth"].size(), 2u);
  EXPECT_EQ(info.json()["frames"], 6);

  const StirAnnotations truth = readStirAnnotations(at("data/seq_1/annotations.json"));
  ASSERT_EQ(truth.size(), 6u);
  EXPECT_EQ(readStirQueries(at("data/seq_1/queries.json")).size(), truth.at(0).size());

  const Outcome benchmark =
      run({"benchmark", "stir2026", at("data"), "--out", at("b"), "--json", "--quiet"});
  ASSERT_EQ(benchmark.exit_code, 0) << benchmark.err;
  const auto json = benchmark.json();
  EXPECT_EQ(json["clips"].size(), 1u);
  EXPECT_TRUE(json["excluded"].empty());
  EXPECT_GT(json["scores_3d"]["ata"], 0.8);
  EXPECT_EQ(json["scores_3d"]["points"], 5 * truth.at(0).size());  // the first frame is left out
  EXPECT_TRUE(json["control_3d"]["aj"].is_number());
  const auto predictions = nlohmann::json::parse(std::ifstream(at("b/preds.json")));
  ASSERT_EQ(predictions["seq_1"].size(), 6u);
  EXPECT_EQ(predictions["seq_1"]["3"]["coords"].size(), truth.at(0).size());
  EXPECT_LT(predictions["seq_1"]["3"]["coords"][0][2], 0.3);  // metres

  // The same clip in our own form, the same pixels followed, judged by `evaluate`.
  ASSERT_EQ(run({"reconstruct", at("own"), "--track", at("b/clips/seq_1/points.csv"), "--out",
                 at("run"), "--quiet"})
                .exit_code,
            0);
  const Outcome evaluated =
      run({"evaluate", at("run"), "--reference", at("own"), "--out", at("e"), "--json", "--quiet"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto tracks = evaluated.json()["tracks"];
  // Truth is rounded to 1e-4 mm in our own form.
  EXPECT_NEAR(json["measured_error"]["mean_mm"].get<double>(), tracks["mean_mm"].get<double>(),
              0.0005)
      << tracks;

  const auto before = fs::last_write_time(at("b/clips/seq_1/run/run.json"));
  EXPECT_EQ(run({"benchmark", "stir2026", at("data"), "--out", at("b"), "--quiet"}).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(at("b/clips/seq_1/run/run.json")), before) << "it was run again";

  fs::copy(at("data/seq_1"), at("data/seq_2"));
  std::ofstream(at("data/seq_2/annotations.json")) << "{\"0/0\":";
  const Outcome broken =
      run({"benchmark", "stir2026", at("data"), "--out", at("b"), "--json", "--quiet"});
  ASSERT_EQ(broken.exit_code, 0) << broken.err;
  EXPECT_EQ(broken.json()["excluded"][0]["clip"], "seq_2");
}

TEST_F(DatasetLayouts, SurgtClipsAreReadAsTheyAre) {
  ASSERT_EQ(simulate("case/1", {"--layout", "surgt", "--frames", "4"}).exit_code, 0);
  const Outcome info = run({"info", at("case/1"), "--json", "--check"});
  ASSERT_EQ(info.exit_code, 0) << info.out << info.err;
  EXPECT_EQ(info.json()["dataset"], "SurgT");
  EXPECT_EQ(info.json()["frames"], 4);
  EXPECT_EQ(info.json()["height_px"], 180);
  const auto truth = readSurgtTruth(at("case/1/gt_rectified_0.yaml"));
  ASSERT_EQ(truth.size(), 4u);
  ASSERT_TRUE(truth[0].visible_in_both);
  EXPECT_GT((*truth[0].boxes)[0][0], (*truth[0].boxes)[1][0]);  // disparity is positive
  EXPECT_EQ(run({"reconstruct", at("case/1"), "--out", at("run"), "--quiet"}).exit_code, 0);
  fs::remove(at("case/1/video.mp4"));
  const Outcome gone = run({"info", at("case/1")});
  EXPECT_EQ(gone.exit_code, 3);
  EXPECT_THAT(gone.err, HasSubstr("video.mp4: is missing"));
}

TEST_F(DatasetLayouts, ScaredKeyframesAreReadAsTheyAreAlsoRaw) {
  ASSERT_EQ(simulate("keyframe_1", {"--layout", "scared", "--set", "scope.k1=-0.1"}).exit_code, 0);
  const Outcome info = run({"info", at("keyframe_1"), "--json"});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(info.json()["dataset"], "SCARED");
  EXPECT_EQ(info.json()["frames"], 1);
  ASSERT_EQ(run({"depth", at("keyframe_1"), "--out", at("d"), "--quiet"}).exit_code, 0);
  StereoCalibration calibration = readCalibration(at("keyframe_1/endoscope_calibration.yaml"));
  const Raster<float> truth = rectifiedDepth(readPointRaster(at("keyframe_1/left_depth_map.tiff")),
                                             Rectifier(calibration).rig());
  const std::string name = fs::exists(at("d/depth.pfm")) ? "d/depth.pfm" : "d/000000_depth.pfm";
  const Raster<float> found = readDepth(at(name));
  ASSERT_TRUE(found.sameShape(truth));
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (std::isfinite(truth.values[i]) && std::isfinite(found.values[i]))
      errors.push_back(std::abs(truth.values[i] - found.values[i]));
  ASSERT_GT(errors.size(), truth.size() / 3);
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2),
                   errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.4);  // mm; a pixel of disparity is 2 mm here
}

/// Each form that ships images or a film: recognised, reconstructed, with the path of our own form.
TEST_F(DatasetLayouts, ShippedFormsAreReconstructedAsOurOwn) {
  const auto clipOf = [](const std::string& layout) -> std::string {
    if (layout == "d4d") return "/clips/Clip_1";
    return layout == "stir" ? "/left/seq01" : "";
  };
  ASSERT_EQ(simulate("own", {"--frames", "2", "--set", "masks=false"}).exit_code, 0);
  ASSERT_EQ(run({"reconstruct", at("own"), "--out", at("own_run"), "--quiet"}).exit_code, 0);
  const Trajectory own = readTrajectory(at("own_run/trajectory.txt"));
  const std::vector<std::pair<std::string, std::string>> forms{
      {"servct", "SERV-CT"}, {"stereomis", "StereoMIS"}, {"d4d", "D4D"},
      {"stir", "STIR"},      {"hamlyn", "Hamlyn"},       {"c3vd", "C3VD"}};
  for (const auto& [layout, form] : forms) {
    ASSERT_EQ(simulate(layout, {"--layout", layout, "--frames", "2"}).exit_code, 0) << layout;
    const std::string clip = at(layout + clipOf(layout));
    const Outcome info = run({"info", clip, "--json", "--check"});
    ASSERT_EQ(info.exit_code, 0) << layout << info.out << info.err;
    EXPECT_EQ(info.json()["dataset"], form);
    EXPECT_EQ(info.json()["frames"], 2) << layout;
    EXPECT_EQ(info.json()["height_px"], 180) << layout;
    if (clip != at(layout)) {
      const Outcome above = run({"info", at(layout)});
      EXPECT_EQ(above.exit_code, 3) << layout;
      EXPECT_THAT(above.err, HasSubstr("the first of them " + clip + " (" + form + ")"));
    }
    const Outcome outcome = run({"reconstruct", clip, "--out", at(layout + "_run"), "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << layout << outcome.err;
    const Trajectory path = readTrajectory(at(layout + "_run/trajectory.txt"));
    ASSERT_EQ(path.size(), own.size()) << layout;
    // Lossless images give the same path; films are compressed, C3VD has depth instead of a pair.
    const bool same = layout == "servct" || layout == "d4d" || layout == "hamlyn";
    for (std::size_t i = 0; i < own.size(); ++i)
      EXPECT_LT(
          (path[i].world_from_left.translation() - own[i].world_from_left.translation()).norm(),
          same ? 1e-5 : 0.3)
          << layout << " frame " << i;
  }
  // Cameras do not fire at one nanosecond; a right image that lacks takes its moment with it.
  const std::string right = at("d4d/clips/Clip_1/right_images_rect/1700000000_");
  fs::rename(right + "040000000.png", right + "041000000.png");
  EXPECT_EQ(run({"info", at("d4d/clips/Clip_1"), "--json"}).json()["frames"], 2);
  fs::remove(right + "000000000.png");
  EXPECT_EQ(run({"info", at("d4d/clips/Clip_1"), "--json"}).json()["frames"], 1);
}

TEST_F(DatasetLayouts, WhatCannotBeIsOneLine) {
  const auto fails = [&](const Outcome& outcome, int code, const std::string& text) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  fails(simulate("a", {"--layout", "stir2027"}), 2, "did you mean `stir2026`");
  fails(simulate("a", {"--layout", "surgt", "--set", "scope.k1=-0.1"}), 2, "rectified images");
  fails(simulate("a", {"--layout", "scared", "--truth", "mesh"}), 2, "--truth");
  fs::create_directories(at("full"));
  std::ofstream(at("full/file")) << "x";
  fails(simulate("full", {"--layout", "scared"}), 2, "not empty");
  fails(run({"benchmark", "stir2026", at("full"), "--out", at("b"), "--quiet"}), 3, "no clip");
  fails(run({"benchmark", "scard", at("full"), "--out", at("b")}), 2, "stir2026");
}

}  // namespace
}  // namespace softscope::test
