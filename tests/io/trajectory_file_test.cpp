#include "io/geometry/trajectory_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/sequences/timestamps_file.h"
#include "io/temporary_folder.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

TEST(TrajectoryFile, ComesBackWithinItsDigits) {
  TemporaryFolder folder;
  TimedPose pose;
  pose.time_s = 12.04;
  pose.world_from_left = Eigen::Translation3d(1.25, -2.5, 80.123456) *
                         Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  writeTrajectory(folder / "t.txt", {TimedPose{}, pose});
  const Trajectory found = readTrajectory(folder / "t.txt");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].world_from_left.matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(found[1].time_s, 12.04);
  // Quaternions carry nine digits: 1e-9 each.
  EXPECT_LT((found[1].world_from_left.linear() - pose.world_from_left.linear()).norm(), 1e-8);
  EXPECT_LT((found[1].world_from_left.translation() - pose.world_from_left.translation()).norm(),
            1e-6);
}

TEST(TrajectoryFile, KittiSFormHasTheSamePosesRowByRow) {
  TimedPose pose;
  pose.world_from_left =
      Eigen::Translation3d(1.25, -2.5, 80) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  const std::string text = kittiText({TimedPose{}, pose});
  EXPECT_EQ(text.substr(0, text.find('\n')), "1 0 0 0 0 1 0 0 0 0 1 0");
  std::istringstream second(text.substr(text.find('\n') + 1));
  const double expected[] = {0, -1, 0, 1.25, 1, 0, 0, -2.5, 0, 0, 1, 80};
  for (const double value : expected) {
    double found = 7;
    ASSERT_TRUE(second >> found);
    EXPECT_NEAR(found, value, 1e-8);  // quaternions of trajectory.txt carry nine digits
  }
}

TEST(TrajectoryFile, TheOrderIsTumS) {
  const Trajectory found = parseTrajectory("# t x y z qx qy qz qw\n\n0.5 1 2 3 0 0 0.6 0.8\n", "t");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].world_from_left.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(found[0].world_from_left.linear()(1, 0), 2 * 0.6 * 0.8, 1e-15);
}

TEST(TrajectoryFile, BadLinesAreNamed) {
  expectError<InputError>([] { parseTrajectory("0 0 0 0 0 0 0 1\n1 2 3\n", "t.txt"); },
                          {"t.txt: line 2", "3 words"});
  expectError<InputError>([] { parseTrajectory("0 0 0 0 0 0 0 2\n", "t"); }, {"quaternion", "2"});
  expectError<InputError>([] { parseTrajectory("0 0 0 0 0 0 0 0\n", "t"); }, {"quaternion"});
  expectError<InputError>([] { parseTrajectory("0 0 nan 0 0 0 0 1\n", "t"); }, {"nan"});
  expectError<InputError>([] { parseTrajectory("0 0 1e12 0 0 0 0 1\n", "t.txt"); },
                          {"t.txt: line 1", "1e+12 mm", "within 1 km"});
  expectError<InputError>([] { parseTrajectory("1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n", "t"); },
                          {"line 2", "Sort"});
  expectError<InputError>([] { parseTrajectory("# none\n", "t"); }, {"no pose"});
  TimedPose bad;
  bad.world_from_left.translation().x() = std::nan("");
  expectError<Error>([&] { trajectoryText({bad}); }, {"not finite"});
}

TEST(TrajectoryFile, ReadsTheDevelopmentData) {
  SOFTSCOPE_DATA_OR_SKIP(data, "openhelp_heart/groundtruth/trajectory.txt");
  const Trajectory found = readTrajectory(data);
  ASSERT_EQ(found.size(), 40U);
  EXPECT_NEAR(found[1].time_s, 0.04, 1e-9);
}

TEST(Timestamps, RiseOneALine) {
  EXPECT_EQ(parseTimestamps("# s\n0\n0.04\n\n0.08\n", "t"), (std::vector<double>{0, 0.04, 0.08}));
  expectError<InputError>([] { parseTimestamps("0\n0\n", "t.txt"); }, {"t.txt: line 2", "later"});
  expectError<InputError>([] { parseTimestamps("0\nx\n", "t"); }, {"line 2", "`x`"});
  EXPECT_EQ(parseTimestamps("1700000000.5\n", "t")[0], 1700000000.5) << "seconds since 1970";
  expectError<InputError>([] { parseTimestamps("1700000000000\n", "t"); }, {"milliseconds"});
  expectError<InputError>([] { parseTimestamps("1700000000000000\n", "t"); }, {"microseconds"});
  expectError<InputError>([] { parseTimestamps("1.7e18\n", "t"); }, {"nanoseconds"});
  expectError<InputError>([] { parseTimestamps("inf\n", "t"); }, {"line 1"});
  expectError<InputError>([] { parseTimestamps("\n", "t"); }, {"no time"});
}

}  // namespace
}  // namespace softscope::test
