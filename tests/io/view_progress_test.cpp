// tests/io/view_progress_test.cpp: frames of which one view stands still, and equal views.
#include "io/sequences/view_progress.h"

#include <gtest/gtest.h>

#include "io/geometry/depth_files.h"
#include "io/sequence_folder.h"
#include "io/sequences/sequence_reader.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

/// Indices of the frames that are refused because of their views.
std::vector<int> refused(const fs::path& sequence, const SequenceOptions& options = {}) {
  std::vector<int> frames;
  SequenceReader reader(sequence, options);
  while (const auto result = reader.next()) {
    EXPECT_EQ(result->ok(), !result->bad_views) << result->error;
    if (result->ok()) continue;
    EXPECT_TRUE(result->unpaired);
    EXPECT_TRUE(result->frame.pair.left.empty());
    frames.push_back(result->index);
  }
  return frames;
}

SequenceOptions withFrames(const std::string& range) {
  SequenceOptions options;
  options.frames = parseFrameRange(range);
  return options;
}

class ViewProgress : public ::testing::Test {
 protected:
  void SetUp() override { makeSequence(folder_.path(), 8); }
  /// The image of frame `from` takes the place of those of `first` to `last`.
  void freeze(const std::string& view, int from, int first, int last) const {
    for (int i = first; i <= last; ++i)
      fs::copy_file(folder_ / (view + "/" + numbered(from)), folder_ / (view + "/" + numbered(i)),
                    fs::copy_options::overwrite_existing);
  }
  std::string reasonOf(int index) const {
    SequenceReader reader(folder_.path());
    while (const auto result = reader.next())
      if (result->index == index) return result->error;
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(ViewProgress, MovingViewsAreUsed) { EXPECT_EQ(refused(folder_.path()), std::vector<int>()); }

TEST_F(ViewProgress, AFrozenRightViewIsRefused) {
  freeze("right", 3, 4, 5);
  EXPECT_EQ(refused(folder_.path()), (std::vector<int>{4, 5}));
  EXPECT_EQ(reasonOf(5).rfind("the right image (000005.png) is that of frame 4, the left one is "
                              "not: the recording of one view stands still.",
                              0),
            0U)
      << reasonOf(5);
}

/// The next image of a resting scene: one pixel differs.
PairDigest restingAfter(PairDigest digest) {
  ++digest.left.bytes;
  return digest;
}

TEST(ViewProgressFault, ARestingSceneMayRepeatOneView) {
  PairDigest first;
  first.left.bytes = 1;
  first.right.bytes = 100;
  const PairDigest next = restingAfter(first);
  EXPECT_EQ(viewProgressFault(EarlierPair{0, first}, next, {}), "");
}

TEST(ViewProgressFault, SlowMotionBesideAFrozenViewAddsUp) {
  PairDigest now;
  now.left.bytes = 1;
  now.right.bytes = 100;
  EarlierPair before{0, now};
  for (int frame = 1; frame < 6; ++frame) {
    now = restingAfter(now);
    now.left.brightness[5] += 0.3F;
    EXPECT_EQ(viewProgressFault(before, now, {}).empty(), frame < 4) << frame;
    before = asEarlier(before, frame, now);
  }
}

TEST_F(ViewProgress, AFrozenLeftViewIsRefused) {
  freeze("left", 0, 1, 1);
  EXPECT_EQ(refused(folder_.path()), std::vector<int>{1});
  EXPECT_NE(reasonOf(1).find("the left image (000001.png) is that of frame 0, the right"),
            std::string::npos);
}

TEST_F(ViewProgress, ARepeatedFrameIsUsed) {
  freeze("right", 3, 4, 5);
  freeze("left", 3, 4, 5);
  EXPECT_EQ(refused(folder_.path()), std::vector<int>());
  SequenceReader reader(folder_.path());
  std::vector<int> repeated;
  while (const auto result = reader.next())
    if (result->repeats) repeated.push_back(result->index);
  EXPECT_EQ(repeated, (std::vector<int>{4, 5}));
}

TEST_F(ViewProgress, ARangeIsComparedLikeTheWholeSequence) {
  freeze("right", 3, 4, 6);
  EXPECT_EQ(refused(folder_.path(), withFrames("5:8")), (std::vector<int>{5, 6}));
  EXPECT_EQ(refused(folder_.path(), withFrames("0:8:3")), std::vector<int>{6});
  EXPECT_EQ(refused(folder_.path(), withFrames("6:8:3")), std::vector<int>{6}) << "as resumed";
  EXPECT_EQ(refused(folder_.path(), withFrames("4:8:4")), std::vector<int>()) << "frame 0 differs";
  SequenceOptions held_out = withFrames("6:8");
  held_out.frames.hold_out_every = 4;  // without the frames 1 and 5
  EXPECT_EQ(refused(folder_.path(), held_out), std::vector<int>{6});
}

TEST_F(ViewProgress, AnOffsetOfTheViewsMovesTheComparison) {
  freeze("right", 3, 4, 5);
  SequenceOptions options;
  options.right_offset = "1";
  SequenceReader reader(folder_.path(), options);
  std::vector<int> bad;
  while (const auto result = reader.next())
    if (result->bad_views) bad.push_back(result->index);
  EXPECT_EQ(bad, (std::vector<int>{3, 4}));
}

TEST_F(ViewProgress, VideosAndPackedViewsAreCompared) {
  TemporaryFolder videos, packed;
  std::vector<ColourImage> left, right, both;
  for (int i = 0; i < 6; ++i) {
    const StereoPair pair{testPair(i).left, testPair(i < 2 ? i : 2).right};
    left.push_back(pair.left);
    right.push_back(pair.right);
    both.push_back(sideBySide(pair));
  }
  for (const TemporaryFolder* folder : {&videos, &packed})
    put(*folder / "calibration.yaml", smallCalibration());
  makeVideo(videos / "left.avi", left);
  makeVideo(videos / "right.avi", right);
  makeVideo(packed / "stereo.avi", both);
  for (const TemporaryFolder* folder : {&videos, &packed}) {
    EXPECT_EQ(refused(folder->path()), (std::vector<int>{3, 4, 5}));
    EXPECT_EQ(refused(folder->path(), withFrames("4:6")), (std::vector<int>{4, 5}));
  }
}

TEST_F(ViewProgress, EqualViewsAreRefused) {
  fs::copy_file(folder_ / "left/000002.png", folder_ / "right/000002.png",
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(refused(folder_.path()), std::vector<int>{2});
  EXPECT_NE(reasonOf(2).find("the left image (000002.png) and the right image (000002.png) are "
                             "equal"),
            std::string::npos);
  for (const char* view : {"left/000004.png", "right/000004.png"})
    writePng(folder_ / view, ColourImage(kWidth, kHeight), true);
  EXPECT_EQ(refused(folder_.path()), std::vector<int>{2}) << "black images show no views";
}

TEST_F(ViewProgress, OneViewGivenTwiceIsAnError) {
  SequencePaths paths = findSequence(folder_.path());
  paths.right = folder_ / "right/../left";
  expectError<InputError>([&] { SequenceReader(paths, {}); },
                          {"left", "given as left and as right view", "Give the right one"});
}

TEST_F(ViewProgress, DepthFilesNeedNoRightView) {
  fs::create_directory(folder_ / "depth");
  for (int i = 0; i < 8; ++i)
    writePfm(folder_ / ("depth/" + numbered(i, ".pfm")), Raster<float>(kWidth, kHeight, 60));
  freeze("right", 3, 4, 5);
  EXPECT_EQ(refused(folder_.path()), std::vector<int>());
}

}  // namespace
}  // namespace softscope::test
