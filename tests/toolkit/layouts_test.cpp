// tests/toolkit/layouts_test.cpp: simulated clips as data sets ship them, read and run.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/calibrations/calibration_reader.h"
#include "io/datasets/surgt_files.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/trajectory_file.h"
#include "io/geometry/xyz_files.h"
#include "io/sequences/sequence_reader.h"
#include "stereo/rectification/rectifier.h"
#include "support/in_folder.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"
#include "toolkit/evaluation/evaluate_run.h"
#include "toolkit/inspection/describe_path.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Layouts : public InFolder {
 protected:
  /// `layout` empty: the form of softscope.
  void simulate(const std::string& out, const std::string& layout,
                const std::vector<std::string>& more) const {
    SimulateOptions options;
    set({"scope.width_px=176", "scope.height_px=132", "instrument.radius_mm=2",
         "organ.cells_per_side=30"},
        &options);
    set(more, &options);
    if (layout.empty())
      simulateSequence(options, {}, at(out), /*overwrite=*/false);
    else
      simulateLayout(options, layout, at(out));
  }
  /// What there is, after a look at every frame.
  Json checked(const std::string& name) const {
    DescribeOptions options;
    options.check_all = true;
    const FactSheet facts = describePath(at(name), options);
    EXPECT_FALSE(facts.hasProblems()) << facts.text();
    return written(facts.json());
  }
  Json evaluated(const std::string& run, const std::string& clip) const {
    EvaluateOptions options;
    options.run = at(run);
    options.reference = clip;
    return written(evaluateRun(options).record);
  }
  Trajectory pathOf(const std::string& clip, const std::string& run) const {
    ReconstructOptions options;
    options.sequence = findSequence(clip);
    options.name = clip;
    options.out = at(run);
    reconstructSequence(options);
    return readTrajectory(at(run + "/trajectory.txt"));
  }
};

TEST_F(Layouts, SurgtClipsAreReadAsTheyAre) {
  simulate("case/1", "surgt", {"frames=4"});
  const Json info = checked("case/1");
  EXPECT_EQ(info["dataset"], "SurgT");
  EXPECT_EQ(info["frames"], 4);
  EXPECT_EQ(info["height_px"], 132);
  const auto truth = readSurgtTruth(at("case/1/gt_rectified_0.yaml"));
  ASSERT_EQ(truth.size(), 4u);
  ASSERT_TRUE(truth[0].visible_in_both);
  EXPECT_GT((*truth[0].boxes)[0][0], (*truth[0].boxes)[1][0]);  // disparity is positive
  EXPECT_EQ(pathOf(at("case/1"), "run").size(), 4u);
  fs::remove(at("case/1/video.mp4"));
  expectError<InputError>([&] { describePath(at("case/1")); }, {"video.mp4: is missing"});
}

TEST_F(Layouts, ScaredKeyframesAreReadAsTheyAreAlsoRaw) {
  simulate("keyframe_1", "scared", {"scope.k1=-0.1"});
  const Json info = checked("keyframe_1");
  EXPECT_EQ(info["dataset"], "SCARED");
  EXPECT_EQ(info["frames"], 1);
  measureSequence(measurement(at("keyframe_1"), at("d")));
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
TEST_F(Layouts, ShippedFormsAreReconstructedAsOurOwn) {
  const auto clipOf = [](const std::string& layout) -> std::string {
    if (layout == "d4d") return "/clips/Clip_1";
    return layout == "stir" ? "/left/seq01" : "";
  };
  simulate("own", "", {"frames=2", "masks=false"});
  const Trajectory own = pathOf(at("own"), "own_run");
  const std::vector<std::pair<std::string, std::string>> forms{
      {"servct", "SERV-CT"}, {"stereomis", "StereoMIS"}, {"d4d", "D4D"},
      {"stir", "STIR"},      {"hamlyn", "Hamlyn"},       {"c3vd", "C3VD"}};
  const std::map<std::string, std::string> truths{
      {"servct", "`softscope benchmark servct`, not by `evaluate`"},
      {"stereomis", "`softscope benchmark stereomis`, not by `evaluate`"},
      {"stir", "`softscope benchmark stir`, not by `evaluate`"},
      {"c3vd", "`softscope benchmark c3vd`, not by `evaluate`"}};
  for (const auto& [layout, form] : forms) {
    SCOPED_TRACE(layout);
    simulate(layout, layout, {"frames=2"});
    const std::string clip = at(layout + clipOf(layout));
    const Json info = checked(layout + clipOf(layout));
    EXPECT_EQ(info["dataset"], form);
    EXPECT_EQ(info["frames"], 2);
    EXPECT_EQ(info["height_px"], 132);
    if (clip != at(layout))
      expectError<InputError>([&, above = at(layout)] { describePath(above); },
                              {"the first of them " + clip + " (" + form + ")"});
    EXPECT_EQ(info.value("depth_files", 0), layout == "c3vd" ? 2 : 0) << "colour is no depth";
    const Trajectory path = pathOf(clip, layout + "_run");
    ASSERT_EQ(path.size(), own.size()) << layout;
    const Json judged = evaluated(layout + "_run", clip);
    EXPECT_EQ(judged["view"]["models_judged"], 2);
    EXPECT_GT(judged["view"]["psnr_db"], 25) << "of the images that the run was made from";
    if (const auto truth = truths.find(layout); truth != truths.end()) {
      EXPECT_THAT(describePath(clip).text(), HasSubstr(truth->second));
      EXPECT_THAT(judged["warnings"].dump(), HasSubstr(truth->second));
    }
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
  EXPECT_EQ(written(describePath(at("d4d/clips/Clip_1")).json())["frames"], 2);
  fs::remove(right + "000000000.png");
  EXPECT_EQ(written(describePath(at("d4d/clips/Clip_1")).json())["frames"], 1);
}

TEST_F(Layouts, MasksOfStereoMisAreIgnoredPixelsOfTheirFrameAndTheNext) {
  simulate("own", "", {"frames=3"});
  simulate("P1", "stereomis", {"frames=3"});
  EXPECT_EQ(checked("P1")["masks"], 2) << "half rate";
  const auto masksOf = [&](const std::string& clip) {
    std::vector<Mask> masks;
    SequenceReader reader(at(clip));
    while (const auto frame = reader.next()) masks.push_back(frame->frame.mask);
    return masks;
  };
  const std::vector<Mask> own = masksOf("own"), found = masksOf("P1");
  ASSERT_EQ(found.size(), 3u);
  for (const int frame : {0, 2}) {
    const Mask &expected = own[std::size_t(frame)], &mask = found[std::size_t(frame)];
    ASSERT_TRUE(mask.sameShape(expected));
    int ignored = 0, different = 0;
    for (int v = 0; v < mask.height_px; ++v)
      for (int u = 0; u < mask.width_px; ++u) {
        const bool is_tissue = expected.at(u - u % 2, v - v % 2) == 0;  // half the size
        ignored += !is_tissue;
        different += (mask.at(u, v) == 0) != is_tissue;
      }
    EXPECT_GT(ignored, 300);
    EXPECT_EQ(different, 0);
  }
  EXPECT_EQ(found[1].values, found[0].values);

  // A damaged mask of a later frame costs that frame; one of the first frame, the sequence.
  fs::resize_file(at("P1/masks/000002l.png"), 40);
  SequenceReader reader(at("P1"));
  EXPECT_TRUE(reader.next()->ok() && reader.next()->ok());
  EXPECT_THAT(reader.next()->error, HasSubstr("masks/000002l.png"));
  fs::resize_file(at("P1/masks/000000l.png"), 40);
  expectError<InputError>([&] { SequenceReader(at("P1")); }, {"masks/000000l.png"});
  // A missing one is a warning; masks in the form of softscope replace them.
  fs::remove(at("P1/masks/000000l.png"));
  EXPECT_THAT(describePath(at("P1")).text(), HasSubstr("2 of 3 frames have no mask"));
  fs::copy(at("own/mask"), at("P1/mask"));
  EXPECT_EQ(masksOf("P1")[2].values, own[2].values);
}

TEST_F(Layouts, WhatAFormCannotHoldIsRefused) {
  const auto refused = [&](const std::string& layout, const std::vector<std::string>& settings,
                           const std::string& part) {
    expectError<OptionError>([&] { simulate("a", layout, settings); }, {part});
  };
  refused("stir2027", {}, "did you mean `stir2026`");
  refused("surgt", {"scope.k1=-0.1"}, "rectified images");
  write("a/file", "x");
  refused("scared", {}, "not empty");
}

}  // namespace
}  // namespace softscope::test
