#include "io/geometry/ply_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

PointCloud twoPoints() {
  PointCloud cloud;
  cloud.points_mm = {{1, 2, 3}, {-4.5F, 5, 60}};
  cloud.normals = {{0, 0, -1}, {std::nanf(""), 0, 0}};
  cloud.colours = {{10, 20, 30}, {255, 0, 128}};
  return cloud;
}

float floatAt(const std::string& bytes, std::size_t at) {
  float value;
  std::memcpy(&value, bytes.data() + at, 4);  // the test machine is little endian, as the file
  return value;
}

TEST(PlyWriter, WritesHeaderAndNumbersExactly) {
  const std::string bytes = plyBytes(twoPoints(), {"left", "LPS"});
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment unit mm\ncomment frame left\n"
      "comment SPACE=LPS\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nend_header\n";
  ASSERT_EQ(bytes.substr(0, header.size()), header);
  ASSERT_EQ(bytes.size(), header.size() + 2 * 27);
  const std::size_t second = header.size() + 27;
  EXPECT_EQ(floatAt(bytes, header.size() + 8), 3);
  EXPECT_EQ(floatAt(bytes, header.size() + 20), -1);
  EXPECT_EQ(floatAt(bytes, second), -4.5F);
  EXPECT_EQ(floatAt(bytes, second + 12), 0);  // no normal there
  EXPECT_EQ(bytes.substr(second + 24, 3), std::string("\xFF\x00\x80", 3));
}

TEST(PlyWriter, LeavesOutWhatTheCloudHasNot) {
  PointCloud cloud;
  cloud.points_mm = {{1, 2, 3}};
  const std::string bytes = plyBytes(cloud, {});
  EXPECT_EQ(bytes.find("nx"), std::string::npos);
  EXPECT_EQ(bytes.find("red"), std::string::npos);
  EXPECT_EQ(bytes.find("SPACE"), std::string::npos);
  EXPECT_EQ(bytes.size() - bytes.find("end_header\n"), 11U + 12U);
}

TEST(PlyWriter, RefusesUnequalCountsAndOverwriting) {
  TemporaryFolder folder;
  PointCloud cloud = twoPoints();
  writePly(folder / "c.ply", cloud, {});
  expectError<OptionError>([&] { writePly(folder / "c.ply", cloud, {}); }, {"`overwrite=`"});
  cloud.normals.pop_back();
  expectError<Error>([&] { plyBytes(cloud, {}); }, {"1 normals", "2 points"});
}

}  // namespace
}  // namespace softscope::test
