// tests/toolkit/calibration_test.cpp: a calibration judged and corrected by a clip of tissue.
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "io/calibrations/calibration_reader.h"
#include "io/calibrations/calibration_writer.h"
#include "support/in_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"
#include "toolkit/calibration/refine_calibration.h"

namespace softscope::test {
namespace {

using testing::HasSubstr;

class RefinedCalibrations : public InFolder {};

/// A calibration whose right camera is turned by some mrad, and the rows of tissue that show it.
TEST_F(RefinedCalibrations, RefineFindsPitchAndRollOfTheRightCameraFromTissueAlone) {
  SimulateOptions options;
  set({"frames=4", "scope.width_px=320", "scope.height_px=240"}, &options);
  simulateSequence(options, {}, at("clip"), /*overwrite=*/false);
  const StereoCalibration truth = readCalibration(at("clip/calibration.yaml"));
  StereoCalibration wrong = truth;
  const Eigen::AngleAxisd pitch(0.004, Eigen::Vector3d::UnitX()),
      roll(0.006, Eigen::Vector3d::UnitZ());
  wrong.right_from_left = Eigen::Isometry3d(pitch * roll) * truth.right_from_left;
  wrong.rectified = false;
  writeCalibration(at("wrong.yaml"), wrong);
  const auto refine = [&](const std::string& calibration, const std::string& out) {
    SequencePaths clip = findSequence(at("clip"));
    clip.calibration = at(calibration);
    const RefinedCalibration refined = refineCalibration(clip, {}, {});
    write(out, refinedCalibrationText(refined));
    return written(refinedCalibrationFacts(refined).json());
  };
  const Json json = refine("wrong.yaml", "refined.yaml");
  EXPECT_EQ(json["frames"], 4);
  EXPECT_GT(json["row_error_px"], 0.8);
  // What single matches scatter by, as with the true calibration.
  const Json scatter = refine("clip/calibration.yaml", "true.yaml");
  EXPECT_NEAR(scatter["row_error_left_px"].get<double>(), scatter["row_error_px"].get<double>(),
              0.02);
  EXPECT_LT(json["row_error_left_px"].get<double>(), 1.5 * scatter["row_error_px"].get<double>());
  EXPECT_LT(json["offset_px"]["ci_95"][0], json["offset_px"]["ci_95"][1]);
  EXPECT_EQ(json["focal_length_plausible"], true) << json;
  const StereoCalibration refined = readCalibration(at("refined.yaml"));
  const Eigen::AngleAxisd left_over(refined.right_from_left.linear());
  const Eigen::Vector3d turn = left_over.angle() * left_over.axis();
  EXPECT_NEAR(turn.x(), 0, 0.0004) << json;  // 0.1 px of rows at this size
  EXPECT_NEAR(turn.z(), 0, 0.0008) << json;
  EXPECT_NEAR(refined.baseline_mm(), truth.baseline_mm(), 1e-9);

  // A focal length of four times the true one is no scope's.
  for (PinholeCamera* camera : {&wrong.left.pinhole, &wrong.right.pinhole})
    camera->fx_px = camera->fy_px = 4 * camera->fx_px;
  wrong.right_from_left.linear().setIdentity();
  wrong.right_from_left.translation() = Eigen::Vector3d(-truth.baseline_mm(), 0, 0);
  writeCalibration(at("long.yaml"), wrong);
  const Json doubted = refine("long.yaml", "long_refined.yaml");
  EXPECT_EQ(doubted["focal_length_plausible"], false);
  EXPECT_THAT(doubted["warnings"].dump(), HasSubstr("focal length"));
}

}  // namespace
}  // namespace softscope::test
