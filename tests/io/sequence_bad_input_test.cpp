// tests/io/sequence_bad_input_test.cpp: sequences that must be refused, and frames that must be
// reported.
#include <gtest/gtest.h>

#include "io/files/file_bytes.h"
#include "io/geometry/depth_files.h"
#include "io/sequence_folder.h"
#include "io/sequences/sequence_reader.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

/// A good sequence of six frames, to be broken.
class BadSequence : public ::testing::Test {
 protected:
  void SetUp() override { makeSequence(folder_.path(), 6); }
  fs::path at(const std::string& name) const { return folder_ / name; }

  void expectRefused(const std::vector<std::string>& parts) const {
    expectError<InputError>([&] { SequenceReader(folder_.path()); }, parts);
  }
  /// Opens; every frame must be good, but `bad`, whose error holds all `parts`.
  void expectOneBadFrame(int bad, const std::vector<std::string>& parts) const {
    SequenceReader reader(folder_.path());
    int count = 0;
    while (const auto result = reader.next()) {
      EXPECT_EQ(result->index, count++);
      EXPECT_EQ(result->ok(), result->index != bad) << result->error;
      if (result->ok()) continue;
      EXPECT_TRUE(result->frame.pair.left.empty());
      for (const std::string& part : parts)
        EXPECT_NE(result->error.find(part), std::string::npos) << part << " in " << result->error;
    }
    EXPECT_EQ(count, 6);
  }
  void cut(const std::string& name, double share) const {
    const std::string bytes = get(at(name));
    put(at(name),
        bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
  }

  TemporaryFolder folder_;
};

TEST_F(BadSequence, MissingPicturesAreNamed) {
  fs::remove(at("right/000003.png"));
  expectRefused({"left/000003.png", "no partner", "6 files", "5 in"});
  fs::remove(at("left/000004.png"));  // now the counts agree, the numbers don't
  expectRefused({"left/000003.png", "no partner"});
}

TEST_F(BadSequence, OneFileTooManyIsNamed) {
  const ColourImage image = testPair(9).left;
  writePng(at("left/overview.png"), image);
  expectRefused({"left/overview.png: has no number", "7 files in", "6 in"});
  fs::remove(at("left/overview.png"));
  writeJpeg(at("left/000003.jpg"), image);
  expectRefused({"left/000003", "has the number of 000003.", "7 files in"});
  fs::rename(at("left/000003.jpg"), at("right/000003.jpg"));
  expectRefused({"right/000003", "has the number of 000003.", "7 in"});
}

TEST_F(BadSequence, MissingViewsAreNamed) {
  fs::remove_all(at("right"));
  expectRefused({"neither a right one nor depth/"});
  fs::remove_all(at("left"));
  expectRefused({"no left view", "stereo.mp4"});
  fs::rename(at("calibration.yaml"), at("camera.yaml"));
  for (const char* name : {"Left", "image_1"}) fs::create_directory(at(name));
  expectRefused({"no left view", "Found there: Left/, camera.yaml, image_1/", "Rename"});
  makeSequence(at("stacked"), 2);
  fs::remove_all(at("stacked/right"));
  expectError<InputError>([&] { SequenceReader(at("stacked/left")); },
                          {"no left view", "2 images", "one video"});
  makeSequence(at("other"), 1);
  fs::remove_all(at("other/left"));
  expectError<InputError>([&] { SequenceReader(at("other")); }, {"right view alone"});
  expectError<InputError>([&] { SequenceReader(at("nowhere")); }, {"no such folder"});
}

TEST_F(BadSequence, EmptyFoldersAndMissingCalibration) {
  fs::remove_all(at("left"));
  fs::create_directory(at("left"));
  expectRefused({"left", "holds no images"});
  makeSequence(at("other"), 1);
  fs::remove(at("other/calibration.yaml"));
  expectError<InputError>([&] { SequenceReader(at("other")); }, {"no calibration"});
}

TEST_F(BadSequence, SymbolicLinkLoopsEnd) {
  fs::remove_all(at("left"));
  fs::create_symlink("left", at("left"));
  expectRefused({"left", "symbolic link", "itself"});
  fs::remove(at("left"));
  fs::create_symlink("..", at("left"));  // a folder that holds itself, and no pictures
  expectRefused({"left"});
}

TEST_F(BadSequence, AFirstFrameThatCannotBeReadThrows) {
  cut("left/000000.png", 0.5);
  expectRefused({"left/000000.png", "truncated"});
}

TEST_F(BadSequence, LaterBadFramesAreReportedAndSkipped) {
  cut("right/000002.png", 0.7);
  expectOneBadFrame(2, {"right/000002.png", "truncated"});
}

TEST_F(BadSequence, AnEmptyPictureIsReported) {
  put(at("left/000005.png"), "");
  expectOneBadFrame(5, {"left/000005.png", "empty"});
}

TEST_F(BadSequence, ATruncatedJpegIsReported) {
  fs::remove(at("left/000001.png"));
  writeJpeg(at("left/000001.jpg"), testPair(1).left);
  cut("left/000001.jpg", 0.6);
  // Its name sorts in the same place.
  expectOneBadFrame(1, {"left/000001.jpg", "truncated"});
}

TEST_F(BadSequence, AJpegThatIsDamagedInsideIsReported) {
  fs::remove(at("left/000001.png"));
  writeJpeg(at("left/000001.jpg"), testPair(1).left);
  std::string bytes = readBytes(at("left/000001.jpg"));
  bytes.erase(bytes.size() / 2, bytes.size() / 4);
  put(at("left/000001.jpg"), bytes);
  expectOneBadFrame(1, {"left/000001.jpg", "damaged inside"});
}

TEST_F(BadSequence, SizesMustBeTheCalibrations) {
  put(at("calibration.yaml"), smallCalibration("image_width: 320\nimage_height: 240\n"));
  expectRefused({"left/000000.png", "160 x 120", "320 x 240", "calibration"});
  put(at("calibration.yaml"), smallCalibration());
  writePng(at("right/000004.png"), makeTexture(80, 60), true);
  expectOneBadFrame(4, {"right/000004.png", "80 x 60", "160 x 120"});
}

TEST_F(BadSequence, MasksMustCoverEveryFrameInItsSize) {
  fs::create_directory(at("mask"));
  for (int i = 0; i < 5; ++i) writePng(at("mask/" + numbered(i)), Mask(kWidth, kHeight, 0));
  expectRefused({"left/000005.png", "no partner", "mask"});
  writePng(at("mask/000005.png"), Mask(kWidth, kHeight, 0));
  writePng(at("mask/000000.png"), Mask(80, 60, 0), true);
  expectRefused({"mask/000000.png", "80 x 60"});
  writePng(at("mask/000000.png"), Mask(kWidth, kHeight, 0), true);
  writePng(at("mask/000003.png"), Mask(80, 60, 0), true);
  expectOneBadFrame(3, {"mask/000003.png", "80 x 60"});
}

TEST_F(BadSequence, DepthMustBeDepth) {
  fs::create_directory(at("depth"));
  for (int i = 0; i < 6; ++i) writePng(at("depth/" + numbered(i)), GrayImage(kWidth, kHeight, 9));
  expectRefused({"depth/000000.png", "8 bits", "16 bits"});
  for (int i = 0; i < 6; ++i) {
    fs::remove(at("depth/" + numbered(i)));
    writePfm(at("depth/" + numbered(i, ".pfm")), Raster<float>(kWidth, kHeight, 0.06F));
  }
  expectRefused({"depth/000000.pfm", "0.06 mm", "In metres?"});
}

TEST_F(BadSequence, TimesMustBeOneAFrame) {
  put(at("timestamps.txt"), "0\n1\n2\n");
  expectRefused({"timestamps.txt", "3 times", "6 frames"});
}

TEST_F(BadSequence, TimesInMillisecondsAreDoubted) {
  put(at("timestamps.txt"), "0\n40\n80\n120\n160\n200\n");
  const auto warnings = SequenceReader(folder_.path()).calibration().warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("timestamps.txt: frames lie 40 s apart"), std::string::npos)
      << warnings[0];
}

TEST_F(BadSequence, VideosThatAreNone) {
  TemporaryFolder folder;
  put(folder / "calibration.yaml", smallCalibration());
  put(folder / "stereo.mp4", "not a video at all");
  expectError<InputError>([&] { SequenceReader(folder.path()); },
                          {"stereo.mp4", "can't be opened"});
  put(folder / "stereo.mp4", "");
  expectError<InputError>([&] { SequenceReader(folder.path()); }, {"stereo.mp4", "empty"});
  put(folder / "left.mp4", "x");
  expectError<InputError>([&] { SequenceReader(folder.path()); }, {"left view", "right"});
}

TEST_F(BadSequence, VideosOfUnequalLength) {
  TemporaryFolder folder;
  put(folder / "calibration.yaml", smallCalibration());
  makeVideo(folder / "left.avi", {testPair(0).left, testPair(1).left, testPair(2).left});
  makeVideo(folder / "right.avi", {testPair(0).right, testPair(1).right});
  expectError<InputError>([&] { SequenceReader(folder.path()); },
                          {"right.avi", "2 frames", "has 3"});
}

TEST_F(BadSequence, VideosOfUnequalRate) {
  TemporaryFolder folder;
  put(folder / "calibration.yaml", smallCalibration());
  makeVideo(folder / "left.avi", {testPair(0).left, testPair(1).left, testPair(2).left}, 30);
  makeVideo(folder / "right.avi", {testPair(0).right, testPair(1).right});
  expectError<InputError>([&] { SequenceReader(folder.path()); },
                          {"right.avi", "2 frames", "rates differ, 25 and 30 frames per second"});
}

TEST_F(BadSequence, ATruncatedVideoEndsWithItsError) {
  TemporaryFolder folder;
  put(folder / "calibration.yaml", smallCalibration());
  std::vector<ColourImage> frames;
  for (int i = 0; i < 10; ++i) frames.push_back(sideBySide(testPair(i)));
  makeVideo(folder / "stereo.avi", frames);
  const std::string bytes = get(folder / "stereo.avi");
  put(folder / "stereo.avi", bytes.substr(0, bytes.size() * 6 / 10));
  SequenceReader reader(folder.path());
  int good = 0;
  std::string error;
  while (const auto result = reader.next()) {
    EXPECT_TRUE(error.empty()) << "a frame after the end";
    good += result->ok() ? 1 : 0;
    error = result->error;
  }
  EXPECT_GE(good, 4);
  EXPECT_LT(good, 10);
  EXPECT_NE(error.find("stereo.avi"), std::string::npos) << error;
}

}  // namespace
}  // namespace softscope::test
