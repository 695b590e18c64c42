#include "io/sequences/sequence_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/geometry/depth_files.h"
#include "io/sequence_folder.h"
#include "io/sequences/frame_window.h"
#include "io/sequences/sequence_settings.h"
#include "io/settings/settings_binder.h"

namespace softscope::test {
namespace {

// Motion JPEG changes this noise by 4.7 grey levels; another frame differs by 20, the other view
// by 16.
constexpr double kVideoTolerance = 8;

/// Reads all; every frame must be testPair(its index) within `tolerance`.
std::vector<Frame> expectTestPairs(SequenceReader& reader, double tolerance) {
  std::vector<Frame> frames;
  while (auto result = reader.next()) {
    EXPECT_TRUE(result->ok()) << result->error;
    if (!result->ok()) break;
    EXPECT_EQ(result->index, result->frame.index);
    const StereoPair wanted = testPair(result->index);
    EXPECT_TRUE(result->frame.pair.left.sameShape(wanted.left));
    EXPECT_LE(meanDifference(result->frame.pair.left, wanted.left), tolerance) << result->index;
    EXPECT_LE(meanDifference(result->frame.pair.right, wanted.right), tolerance) << result->index;
    frames.push_back(std::move(result->frame));
  }
  return frames;
}

std::vector<ColourImage> packed(int count, ColourImage (*pack)(const StereoPair&)) {
  std::vector<ColourImage> out;
  for (int i = 0; i < count; ++i) out.push_back(pack(testPair(i)));
  return out;
}

void makeTwoVideos(const TemporaryFolder& folder, int count) {
  put(folder / "calibration.yaml", smallCalibration());
  std::vector<ColourImage> left, right;
  for (int i = 0; i < count; ++i) {
    left.push_back(testPair(i).left);
    right.push_back(testPair(i).right);
  }
  makeVideo(folder / "left.avi", left);
  makeVideo(folder / "right.avi", right);
}

// A back end recognises a frame by its address when the window moves on to it.
TEST(FrameWindow, HoldsTheUpcomingFramesInPlaceUpToAnUnreadableOne) {
  constexpr int kFrames = 8, kBroken = 6;
  TemporaryFolder folder;
  makeSequence(folder.path(), kFrames);
  put(folder / "right" / "000006.png", "broken");
  SequenceReader reader(folder.path());
  FrameWindow window(reader);
  EXPECT_TRUE(window.upcoming().empty());
  UpcomingFrames expected;
  for (int i = 0; i < kFrames; ++i) {
    const FrameResult* result = window.advance();
    ASSERT_NE(result, nullptr);
    EXPECT_EQ(result->index, i);
    EXPECT_EQ(result->ok(), i != kBroken);
    if (!expected.empty()) {
      EXPECT_EQ(expected.front().get(), &result->frame);
    }
    const UpcomingFrames upcoming = window.upcoming();
    const int last = std::min(i + FrameWindow::kUpcoming, (i < kBroken ? kBroken : kFrames) - 1);
    ASSERT_EQ(upcoming.size(), std::size_t(last - i)) << i;
    for (std::size_t k = 1; k < expected.size(); ++k) EXPECT_EQ(upcoming[k - 1], expected[k]) << i;
    expected = upcoming;
  }
  EXPECT_EQ(window.advance(), nullptr);
  EXPECT_EQ(window.advance(), nullptr);
  EXPECT_TRUE(window.upcoming().empty());
}

TEST(SequenceReader, ReadsAFolderOfPictures) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 12);
  SequenceReader reader(folder.path());
  EXPECT_EQ(reader.frameCount(), 12);
  EXPECT_EQ(reader.calibration().left.pinhole.width_px, kWidth);
  const auto frames = expectTestPairs(reader, 0);
  ASSERT_EQ(frames.size(), 12U);
  EXPECT_TRUE(std::isnan(frames[3].time_s));
  EXPECT_TRUE(frames[3].mask.empty());
  EXPECT_TRUE(frames[3].depth_mm.empty());
  EXPECT_FALSE(reader.next());  // still nothing
}

TEST(SequenceReader, ReadsARange) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 8);
  SequenceOptions options;
  options.frames = parseFrameRange("3:6");
  SequenceReader reader(folder.path(), options);
  EXPECT_EQ(reader.frameCount(), 3);
  EXPECT_EQ(reader.totalCount(), 8);
  const auto frames = expectTestPairs(reader, 0);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].index, 3);
  options.frames = parseFrameRange("6:9");
  expectError<OptionError>([&] { SequenceReader(folder.path(), options); },
                           {"`frames=` 6:9", "8 frames"});
}

TEST(SequenceReader, FrameRangesAreHalfOpen) {
  EXPECT_EQ(parseFrameRange("2:").begin, 2);
  EXPECT_EQ(parseFrameRange("2:").end, -1);
  EXPECT_EQ(parseFrameRange(":7").end, 7);
  EXPECT_EQ(parseFrameRange(":").begin, 0);
  for (const char* text :
       {"", "5", "5:5", "7:3", "-1:4", "a:b", "1:2:3:4", "1:5:0", "1:5:-2", "1:5:a", "1.5:2"})
    expectError<OptionError>([&] { parseFrameRange(text); }, {"`frames=`"});
}

TEST(SequenceReader, ReadsEveryStepthFrameUnderItsOwnNumber) {
  EXPECT_EQ(parseFrameRange("1:9:3").step, 3);
  EXPECT_EQ(parseFrameRange("::5").step, 5);
  EXPECT_EQ(parseFrameRange("2:7:").step, 1);
  for (const bool video : {false, true}) {
    TemporaryFolder folder;
    if (video)
      makeTwoVideos(folder, 9);
    else
      makeSequence(folder.path(), 9);
    SequenceOptions options;
    options.frames = parseFrameRange("1:9:3");
    SequenceReader reader(folder.path(), options);
    EXPECT_EQ(reader.frameCount(), 3);
    const auto frames = expectTestPairs(reader, video ? kVideoTolerance : 0);
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[0].index, 1);
    EXPECT_EQ(frames[1].index, 4);
    EXPECT_EQ(frames[2].index, 7);
  }
}

// Frame 0 of a clip whose first picture is IMG_0120 is known to its owner as 120.
TEST(SequenceReader, TellsTheNamesAndNumbersOfTheFiles) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 3);
  for (const char* side : {"left", "right"})
    for (int i = 0; i < 3; ++i)
      std::filesystem::rename(folder / side / numbered(i),
                              folder / side / (std::string(side) + "_" + numbered(120 + i)));
  SequenceOptions options;
  options.right_offset = "-1";
  SequenceReader reader(folder.path(), options);
  const auto first = reader.next(), second = reader.next();
  EXPECT_TRUE(first->unpaired);
  EXPECT_EQ(first->names.number, 120);
  EXPECT_EQ(first->names.left, "left_000120.png");
  EXPECT_EQ(first->names.right, "");
  EXPECT_FALSE(second->unpaired);
  EXPECT_EQ(second->names.number, 121);
  EXPECT_EQ(second->names.right, "right_000120.png");

  TemporaryFolder videos;
  makeTwoVideos(videos, 2);
  SequenceReader of_video(videos.path());
  of_video.next();
  const auto last = of_video.next();
  EXPECT_EQ(last->names.number, 1);
  EXPECT_EQ(last->names.left, "left.avi");
}

TEST(SequenceReader, ReadsMasksDepthAndTimes) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 3);
  std::filesystem::create_directories(folder / "mask");
  std::filesystem::create_directories(folder / "depth");
  for (int i = 0; i < 3; ++i) {
    Mask mask(kWidth, kHeight, 0);
    mask.at(i, 0) = 7;
    writePng(folder / "mask" / numbered(i), mask);
    writeDepthPng(folder / "depth" / numbered(i), Raster<float>(kWidth, kHeight, 50.0F + i), 0.02);
  }
  put(folder / "timestamps.txt", "0.5\n0.6\n0.8\n");
  put(folder / "calibration.yaml",
      smallCalibration("depth_unit_mm: 0.02\nimage_width: 160\nimage_height: 120\n"));
  SequenceReader reader(folder.path());
  const auto frames = expectTestPairs(reader, 0);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[2].time_s, 0.8);
  EXPECT_NE(frames[2].mask.at(2, 0), 0);
  EXPECT_EQ(frames[2].mask.at(1, 0), 0);
  EXPECT_FLOAT_EQ(frames[1].depth_mm.at(9, 9), 51);
}

TEST(SequenceReader, DepthStandsInForTheRightView) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 2);
  std::filesystem::remove_all(folder / "right");
  expectError<InputError>([&] { SequenceReader(folder.path()); },
                          {"neither a right one nor depth/"});
  std::filesystem::create_directories(folder / "depth");
  for (int i = 0; i < 2; ++i)
    writePfm(folder / "depth" / numbered(i, ".pfm"), Raster<float>(kWidth, kHeight, 50));
  SequenceReader reader(folder.path());
  const auto result = reader.next();
  ASSERT_TRUE(result && result->ok());
  EXPECT_TRUE(result->frame.pair.right.empty());
  EXPECT_EQ(result->frame.depth_mm.at(0, 0), 50);
}

TEST(SequenceReader, ReadsTwoVideos) {
  TemporaryFolder folder;
  makeTwoVideos(folder, 7);
  SequenceReader reader(folder.path());
  EXPECT_EQ(reader.frameCount(), 7);
  const auto frames = expectTestPairs(reader, kVideoTolerance);
  ASSERT_EQ(frames.size(), 7U);
  EXPECT_NEAR(frames[5].time_s, 0.2, 1e-9);  // 25 frames a second
  SequenceOptions options;
  options.frames = {4, -1};
  SequenceReader late(folder.path(), options);
  EXPECT_EQ(expectTestPairs(late, kVideoTolerance).size(), 3U);
}

/// Left picture f with right picture f - 1; of the first one only an error.
void expectRightBefore(SequenceReader& reader, int count, double tolerance) {
  const auto alone = reader.next();
  ASSERT_TRUE(alone && !alone->ok());
  EXPECT_EQ(alone->index, 0);
  EXPECT_THAT(alone->error, testing::HasSubstr("no image of this moment"));
  for (int f = 1; f < count; ++f) {
    const auto result = reader.next();
    ASSERT_TRUE(result && result->ok());
    EXPECT_EQ(result->index, f);
    EXPECT_LE(meanDifference(result->frame.pair.left, testPair(f).left), tolerance);
    EXPECT_LE(meanDifference(result->frame.pair.right, testPair(f - 1).right), tolerance);
  }
  EXPECT_FALSE(reader.next());
}

TEST(SequenceReader, PairsViewsThatArePicturesApart) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 5);
  SequenceOptions options;
  options.right_offset = "-1";
  SequenceReader reader(folder.path(), options);
  EXPECT_EQ(reader.frameCount(), 5);
  expectRightBefore(reader, 5, 0);

  options.right_offset = "2";
  SequenceReader later(folder.path(), options);
  for (int f = 0; f < 3; ++f)
    EXPECT_EQ(meanDifference(later.next()->frame.pair.right, testPair(f + 2).right), 0);
  EXPECT_FALSE(later.next()->ok());
  EXPECT_FALSE(later.next()->ok());
  EXPECT_FALSE(later.next());
}

TEST(SequenceReader, PairsVideosThatArePicturesApart) {
  TemporaryFolder folder;
  makeTwoVideos(folder, 5);
  SequenceOptions options;
  options.right_offset = "-1";
  SequenceReader reader(folder.path(), options);
  expectRightBefore(reader, 5, kVideoTolerance);
}

TEST(SequenceReader, RefusesAnOffsetThatPairsNothing) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 3);
  SequenceOptions options;
  options.right_offset = "-3";
  expectError<OptionError>([&] { SequenceReader(folder.path(), options); },
                           {"sequence.right_offset is -3", "3 images"});
  for (const char* text : {"one", "0.5", "", "1e9"}) {
    options.right_offset = text;
    expectError<OptionError>([&] { SequenceReader(folder.path(), options); },
                             {"sequence.right_offset", "auto or a whole number"});
  }
}

TEST(SequenceReader, ReadsOneVideoInEveryLayout) {
  ColourImage (*const packs[])(const StereoPair&) = {sideBySide, topBottom, interlaced};
  for (const auto pack : packs) {
    TemporaryFolder folder;
    put(folder / "calibration.yaml", smallCalibration());
    makeVideo(folder / "stereo.avi", packed(4, pack));
    SequenceReader reader(folder.path());
    // Interlaced views share JPEG's blocks, which costs 7.6 grey levels.
    EXPECT_EQ(expectTestPairs(reader, pack == interlaced ? 12 : kVideoTolerance).size(), 4U);
  }
}

TEST(SequenceReader, TakesASizeThatTheCalibrationLeavesOutFromThePictures) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 2);
  put(folder / "calibration.yaml", smallCalibration(""));
  SequenceReader reader(folder.path());
  EXPECT_EQ(reader.calibration().right.pinhole.width_px, kWidth);
  EXPECT_EQ(reader.calibration().left.pinhole.height_px, kHeight);
  ASSERT_EQ(reader.calibration().warnings.size(), 1U);
  EXPECT_NE(reader.calibration().warnings[0].find("160 x 120"), std::string::npos);
}

TEST(SequenceReader, WarnsOfACalibrationForAnotherSize) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 1);
  std::string text = smallCalibration("");  // for 200 x 150
  const std::string centre = "150,0,80,0,150,60", scaled = "188,0,99.5,0,188,74.5";
  for (std::size_t at = text.find(centre); at != std::string::npos; at = text.find(centre))
    text.replace(at, centre.size(), scaled);
  put(folder / "calibration.yaml", text);
  const auto warnings = SequenceReader(folder.path()).calibration().warnings;
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[1].find("about 200 x 150 pixels, not of 160 x 120"), std::string::npos)
      << warnings[1];
}

TEST(SequenceReader, TakesAUsersOwnLayout) {
  TemporaryFolder folder;
  put(folder / "rig.yaml", smallCalibration());
  writePng(folder / "eye_l.png", testPair(0).left);
  writePng(folder / "eye_r7.png", testPair(0).right);
  SequencePaths paths;
  paths.left = folder / "eye_l.png";
  paths.right = folder / "eye_r7.png";
  paths.calibration = folder / "rig.yaml";
  SequenceReader reader(paths, {});
  EXPECT_EQ(expectTestPairs(reader, 0).size(), 1U);
  paths.calibration.clear();
  expectError<OptionError>([&] { SequenceReader(paths, {}); }, {"`calibration=`"});
}

TEST(SequenceReader, KeepsFewFramesReadyAndStopsWhenLeft) {
  TemporaryFolder folder;
  makeSequence(folder.path(), 10);
  SequenceOptions options;
  options.read_ahead = 1;
  for (int taken = 0; taken < 4; ++taken) {  // destroyed with its thread waiting at each stage
    SequenceReader reader(folder.path(), options);
    for (int i = 0; i < taken; ++i) EXPECT_TRUE(reader.next()->ok());
  }
  SequenceReader first(folder.path(), options), second(folder.path(), options);
  first = std::move(second);
  EXPECT_EQ(expectTestPairs(first, 0).size(), 10U);
}

TEST(SequenceReader, OptionsAreBoundAndChecked) {
  SequenceOptions options;
  SettingsBinder binder;
  describe(binder, options);
  Settings settings;
  addAssignment(settings, "sequence.layout=top-bottom");
  addAssignment(settings, "calibration.baseline_mm=4.3");
  binder.apply(settings);
  EXPECT_EQ(options.layout, "top-bottom");
  EXPECT_EQ(options.calibration.baseline_mm, 4.3);
  EXPECT_NO_THROW(options.validate());
  options.layout = "diagonal";
  expectError<OptionError>([&] { options.validate(); }, {"sequence.layout is diagonal"});
}

}  // namespace
}  // namespace softscope::test
