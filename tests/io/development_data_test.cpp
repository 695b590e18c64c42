// tests/io/development_data_test.cpp: whole sequences and real calibrations, as the larger test
// data have them.
#include <gtest/gtest.h>

#include <cmath>

#include "io/calibrations/calibration_reader.h"
#include "io/sequences/sequence_reader.h"
#include "io/temporary_folder.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

int countFrames(SequenceReader& reader) {
  int count = 0;
  while (const auto result = reader.next()) {
    EXPECT_TRUE(result->ok()) << result->error;
    ++count;
  }
  return count;
}

TEST(DevelopmentData, OpenCasInOneFileAndSplit) {
  SOFTSCOPE_DATA_OR_SKIP(data, "opencas_ct");
  const auto whole = readCalibration(data);
  EXPECT_EQ(whole.form, "OpenCAS");
  EXPECT_EQ(whole.left.pinhole.width_px, 720);
  EXPECT_EQ(whole.left.pinhole.height_px, 576);
  EXPECT_DOUBLE_EQ(whole.left.pinhole.fx_px, 439.1244812012);
  EXPECT_DOUBLE_EQ(whole.right.pinhole.cy_px, 302.8897399902);
  EXPECT_DOUBLE_EQ(whole.left.distortion.coefficients[0], -0.7391278148);
  EXPECT_DOUBLE_EQ(whole.right.distortion.coefficients[7], -19.3593158722);
  EXPECT_NEAR(whole.baseline_mm(), 4.3756, 1e-4);  // the norm of the file's T
  EXPECT_TRUE(whole.warnings.empty());

  const auto split = readCalibration(data / "calib.left.intrinsics.txt");
  EXPECT_EQ(split.left.distortion.coefficients[5], 0);
  ASSERT_EQ(split.warnings.size(), 1U);
  EXPECT_NE(split.warnings[0].find("rational"), std::string::npos);
  // Both forms have the same rig, the split one with one digit less in R.
  EXPECT_LT((split.right_from_left.matrix() - whole.right_from_left.matrix()).norm(), 1e-8);
}

TEST(DevelopmentData, OpenCasPairThroughAUsersOwnLayout) {
  SOFTSCOPE_DATA_OR_SKIP(data, "opencas_ct");
  SequencePaths paths;
  paths.left = data / "left.png";
  paths.right = data / "right.png";
  paths.calibration = data;
  paths.mask = data / "Stereo_SD_d_complete_22_MASK_eval.png";
  SequenceReader reader(paths, {});
  const auto result = reader.next();
  ASSERT_TRUE(result && result->ok());
  EXPECT_FALSE(result->frame.mask.empty());
}

TEST(DevelopmentData, EndoNerfClipWithItsMasks) {
  SOFTSCOPE_DATA_OR_SKIP(data, "endonerf_pulling");
  SequenceReader reader(data);
  EXPECT_EQ(reader.frameCount(), 63);
  EXPECT_NEAR(reader.calibration().baseline_mm(), 4.324, 1e-12);
  EXPECT_TRUE(reader.calibration().rectified);
  EXPECT_TRUE(reader.calibration().warnings.empty());
  EXPECT_EQ(countFrames(reader), 63);
}

TEST(DevelopmentData, EverySequenceFolder) {
  SOFTSCOPE_DATA_OR_SKIP(data, "bdis_tissue");
  const std::pair<const char*, int> folders[] = {
      {"bdis_tissue", 8}, {"openhelp_heart", 40}, {"openhelp_kidney_small", 40}};
  for (const auto& [name, count] : folders) {
    SequenceReader reader(dataFolder(name));
    EXPECT_TRUE(reader.calibration().warnings.empty()) << name;
    EXPECT_EQ(countFrames(reader), count) << name;
  }
}

}  // namespace
}  // namespace softscope::test
