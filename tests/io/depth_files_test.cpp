#include "io/geometry/depth_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "io/geometry/pfm_file.h"
#include "io/images/image_codec.h"
#include "io/temporary_folder.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

const float kNan = std::nanf("");

Raster<float> smallDepth() {
  Raster<float> depth_mm(3, 2, kNan);
  depth_mm.at(0, 0) = 50.0F;
  depth_mm.at(2, 0) = 73.256F;
  depth_mm.at(1, 1) = 655.35F;
  return depth_mm;
}

TEST(DepthFiles, PngHoldsHundredthsOfAMillimetreAndZeroForNone) {
  TemporaryFolder folder;
  writeDepthPng(folder / "d.png", smallDepth());
  const cv::Mat raw = cv::imread((folder / "d.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(raw.at<std::uint16_t>(0, 0), 5000);
  EXPECT_EQ(raw.at<std::uint16_t>(0, 1), 0);
  EXPECT_EQ(raw.at<std::uint16_t>(0, 2), 7326);  // rounded
  EXPECT_EQ(raw.at<std::uint16_t>(1, 1), 65535);
  const Raster<float> found = readDepth(folder / "d.png");
  EXPECT_FLOAT_EQ(found.at(2, 0), 73.26F);
  EXPECT_TRUE(std::isnan(found.at(1, 0)));
  EXPECT_FLOAT_EQ(readDepth(folder / "d.png", 0.1).at(0, 0), 500.0F);
}

TEST(DepthFiles, WhatPngCannotHoldBecomesNoneNeverAnotherDepth) {
  TemporaryFolder folder;
  Raster<float> depth_mm(4, 1);
  depth_mm.values = {655.36F, -3.0F, 0.004F, INFINITY};
  writeDepthPng(folder / "d.png", depth_mm);
  for (const float value : readDepth(folder / "d.png").values) EXPECT_TRUE(std::isnan(value));
}

TEST(DepthFiles, PfmAndTiffComeBackBitByBit) {
  TemporaryFolder folder;
  writePfm(folder / "d.pfm", smallDepth());
  const Raster<float> floats = smallDepth();
  ASSERT_TRUE(cv::imwrite((folder / "d.tif").string(), matrixView(floats, CV_32F)));
  for (const char* name : {"d.pfm", "d.tif"}) {
    const Raster<float> found = readDepth(folder / name);
    ASSERT_EQ(found.width_px, 3) << name;
    ASSERT_EQ(found.height_px, 2) << name;
    EXPECT_EQ(found.at(2, 0), 73.256F) << name;
    EXPECT_EQ(found.at(1, 1), 655.35F) << name;
    EXPECT_TRUE(std::isnan(found.at(0, 1))) << name;
  }
  const cv::Mat raw = cv::imread((folder / "d.pfm").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(raw.at<float>(0, 2), 73.256F);  // another reader agrees on the order of rows
}

TEST(DepthFiles, DisparityKeepsItsSignAndItsSteps) {
  TemporaryFolder folder;
  Raster<float> disparity_px(3, 1);
  disparity_px.values = {12.5F, kNan, -1.25F};
  writePfm(folder / "d.pfm", disparity_px);
  EXPECT_EQ(readDisparity(folder / "d.pfm").at(2, 0), -1.25F);
  writeDisparityPng(folder / "d.png", disparity_px);
  EXPECT_EQ(cv::imread((folder / "d.png").string(), -1).at<std::uint16_t>(0, 0), 3200);
  EXPECT_EQ(readDisparity(folder / "d.png").at(0, 0), 12.5F);
  EXPECT_TRUE(std::isnan(readDisparity(folder / "d.png").at(2, 0)));
}

TEST(Pfm, ReadsBothByteOrdersAndTurnsRows) {
  const auto raw = [](float value, bool big) {
    char bytes[4];
    std::memcpy(bytes, &value, 4);
    return big ? std::string{bytes[3], bytes[2], bytes[1], bytes[0]} : std::string(bytes, 4);
  };
  for (const bool big : {false, true}) {
    const std::string file = std::string("Pf\n2 2\n") + (big ? "1.0" : "-1.0") + "\n" +
                             raw(1, big) + raw(2, big) + raw(INFINITY, big) + raw(4, big);
    const Raster<float> found = parsePfm(file, "x");
    EXPECT_EQ(found.at(0, 1), 1);  // the file begins with the lowest row
    EXPECT_EQ(found.at(1, 1), 2);
    EXPECT_TRUE(std::isnan(found.at(0, 0)));
    EXPECT_EQ(found.at(1, 0), 4);
  }
}

TEST(Pfm, RefusesWhatIsNotWhole) {
  const std::string good = pfmBytes(smallDepth());
  EXPECT_NO_THROW(parsePfm(good, "x"));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(parsePfm(good.substr(0, size), "x"), InputError) << size;
  expectError<InputError>([&] { parsePfm(good + "x", "x.pfm"); }, {"x.pfm", "25 bytes", "24"});
  expectError<InputError>([] { parsePfm("PF\n2 2\n-1\n", "x"); }, {"colour"});
  expectError<InputError>([] { parsePfm("Pf\n2 2\n0\n1234", "x"); }, {"header"});
  expectError<InputError>([] { parsePfm("Pf\n99999 99999\n-1\n", "x"); }, {"99999"});
  expectError<InputError>([] { parsePfm("Pf\n-2 -2\n-1\n1234123412341234", "x"); }, {"-2 x -2"});
  expectError<InputError>([] { parsePfm("Pf\n1e300 nan\n-1\n", "x"); }, {"header"});
}

TEST(DepthFiles, RefusesPicturesThatAreNoDepth) {
  const std::string eight = encodeImage(".png", cv::Mat(3, 3, CV_8U, cv::Scalar(9)));
  expectError<InputError>([&] { parseDepth(eight, "d.png"); }, {"d.png", "8 bits", "16 bits"});
  const std::string colour = encodeImage(".png", cv::Mat(3, 3, CV_16UC3, cv::Scalar(9, 9, 9)));
  expectError<InputError>([&] { parseDepth(colour, "d.png"); }, {"3 channel(s)"});
  const std::string tiff = encodeImage(".tif", cv::Mat(30, 30, CV_32F, cv::Scalar(9)));
  expectError<InputError>([&] { parseDepth(tiff.substr(0, tiff.size() / 2), "d.tif"); }, {"d.tif"});
}

TEST(DepthFiles, ReadsTheDevelopmentData) {
  SOFTSCOPE_DATA_OR_SKIP(data, "openhelp_heart/groundtruth/depth/000000.png");
  const Raster<float> depth_mm = readDepth(data);
  EXPECT_EQ(depth_mm.width_px, 640);
  for (const float value : depth_mm.values) {
    if (std::isnan(value)) continue;
    ASSERT_TRUE(value > 20 && value < 300) << value;  // a heart before a scope
  }
}

}  // namespace
}  // namespace softscope::test
