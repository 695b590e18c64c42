// tests/toolkit/sequence_process_test.cpp: api::Reconstructor::process() of a Sequence.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "io/files/folder.h"
#include "softscope/reconstructor.h"
#include "support/in_folder.h"
#include "support/run_results.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

api::Options smallDisparities() {
  api::Options options;
  options.set("stereo.disparity_max_px", "63");
  return options;
}

/// Waits up to ten seconds.
bool appears(const fs::path& file) {
  for (int i = 0; i < 1000 && !fs::exists(file); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return fs::exists(file);
}

class ProcessOfASequence : public InFolder {
 protected:
  void makeClip(int frames) const { simulateClip(at("clip"), frames); }
  void damage(const std::string& image) const { write("clip/" + image, "broken"); }
  api::Reconstructor reconstructorOf(const api::Sequence& sequence) const {
    return api::Reconstructor(sequence.calibration(), smallDisparities(), "cpu");
  }
  /// Without look-ahead, one frame after the other.
  api::Model modelOfFrames(int count) const {
    api::Sequence sequence(at("clip"));
    api::Reconstructor reconstructor = reconstructorOf(sequence);
    for (int i = 0; i < count; ++i) reconstructor.process(sequence.next()->view());
    return reconstructor.model();
  }
};

TEST_F(ProcessOfASequence, WritesTheBytesOfTheCommand) {
  makeClip(7);
  damage("right/000003.png");
  ReconstructOptions command = reconstruction(at("clip"), at("command"));
  command.save_every = 2;
  command.backend = "cpu";
  reconstructSequence(command);

  api::Sequence sequence(at("clip"));
  api::Reconstructor reconstructor = reconstructorOf(sequence);
  reconstructor.recordTo(at("run"), /*save_every=*/2);
  std::vector<std::string> statuses;
  while (const auto report = reconstructor.process(sequence)) {
    EXPECT_EQ(report->frame, static_cast<int>(statuses.size()));
    statuses.push_back(report->status);
    if (report->frame == 3) {
      EXPECT_THAT(report->reason, HasSubstr("right/000003.png"));
    }
  }
  EXPECT_THAT(statuses,
              ElementsAre("started", "fused", "fused", "unreadable", "fused", "fused", "fused"));
  EXPECT_FALSE(reconstructor.process(sequence)) << "each frame is read once";
  EXPECT_EQ(reconstructor.finish().frames().size(), 7U);

  const auto files = resultsIn(at("run")), expected = resultsIn(at("command"));
  EXPECT_EQ(files.size(), expected.size());
  for (const auto& [name, bytes] : expected) {
    ASSERT_EQ(files.count(name), 1U) << name;
    EXPECT_TRUE(files.at(name) == bytes) << name;
  }
  EXPECT_EQ(recordWithoutTimes(at("run")), recordWithoutTimes(at("command")));
  EXPECT_THAT(textOf(at("run/frames.csv")),
              testing::AllOf(HasSubstr("\"000003.png: "), testing::Not(HasSubstr("/000003.png"))));
}

TEST_F(ProcessOfASequence, UsesTheSettingsOfTheSequence) {
  makeClip(4);
  api::Options later = smallDisparities();
  later.set("sequence.right_offset", "1");
  api::Sequence sequence(at("clip"), later), plain(at("clip"));
  plain.next();
  EXPECT_EQ(sequence.next()->right.values, plain.next()->right.values);

  api::Reconstructor reconstructor(sequence.calibration(), later, "cpu");
  expectError<OptionError>([&] { reconstructor.process(plain); },
                           {"`sequence.right_offset=` 1", "but not to the Sequence"});
  reconstructor.recordTo(at("run"), /*save_every=*/0);
  while (reconstructor.process(sequence)) {
  }
  reconstructor.finish();
  EXPECT_EQ(recordWithoutTimes(at("run"))["configuration"]["sequence.right_offset"], "1");
}

TEST_F(ProcessOfASequence, TellsThatTheVideoStoodStill) {
  makeClip(6);
  for (const std::string view : {"clip/left/", "clip/right/"})
    for (const int i : {3, 4})
      fs::copy_file(at(view + numberedName(2, ".png")), at(view + numberedName(i, ".png")),
                    fs::copy_options::overwrite_existing);
  const std::string told = "both images of 2 of 6 frames are those of the frame before";
  ReconstructOptions command = reconstruction(at("clip"), at("command"));
  command.backend = "cpu";
  EXPECT_THAT(written(reconstructSequence(command).record)["warnings"].dump(), HasSubstr(told));
  api::Sequence sequence(at("clip"));
  api::Reconstructor reconstructor = reconstructorOf(sequence);
  reconstructor.recordTo(at("run"), /*save_every=*/0);
  while (reconstructor.process(sequence)) {
  }
  reconstructor.finish();
  EXPECT_THAT(recordWithoutTimes(at("run"))["warnings"].dump(), HasSubstr(told));
}

TEST_F(ProcessOfASequence, UpdatesItsFilesEveryHundredFrames) {
  makeClip(2);
  fs::remove(at("clip/timestamps.txt"));
  for (const std::string view : {"left", "right"})
    for (int i = 2; i < 101; ++i) damage(view + "/" + numberedName(i, ".png"));
  api::Sequence sequence(at("clip"));
  api::Reconstructor reconstructor = reconstructorOf(sequence);
  reconstructor.recordTo(at("run"), /*save_every=*/0);
  for (int i = 0; i < 99; ++i) reconstructor.process(sequence);
  EXPECT_FALSE(fs::exists(at("run/frames.csv")));
  reconstructor.process(sequence);
  ASSERT_TRUE(appears(at("run/checkpoint.bin")));  // written last
  const std::string table = textOf(at("run/frames.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 101);
  EXPECT_TRUE(fs::exists(at("run/model.ply")));
}

TEST_F(ProcessOfASequence, MayStopAtAnyFrameAndGoOn) {
  makeClip(6);
  api::Sequence sequence(at("clip"));
  api::Reconstructor reconstructor = reconstructorOf(sequence);
  reconstructor.recordTo(at("run"), /*save_every=*/0);
  reconstructor.process(sequence);
  reconstructor.process(sequence);
  const auto image = sequence.next();
  EXPECT_EQ(image->index, 2);
  EXPECT_EQ(reconstructor.process(image->view()).frame, 2);
  EXPECT_EQ(reconstructor.process(sequence)->frame, 3);
  EXPECT_EQ(reconstructor.finish().frames().size(), 4U);
  EXPECT_EQ(reconstructor.process(sequence)->frame, 4) << "without a folder";
  EXPECT_EQ(reconstructor.model().points_mm, modelOfFrames(5).points_mm);
}

// The images of the following frames are still read when their sequence ends.
TEST_F(ProcessOfASequence, MayOutliveTheSequence) {
  makeClip(4);
  auto sequence = std::make_unique<api::Sequence>(at("clip"));
  api::Reconstructor reconstructor = reconstructorOf(*sequence);
  EXPECT_TRUE(reconstructor.process(*sequence)->fused);
  sequence.reset();
  api::Sequence again(at("clip"));
  again.next();
  for (int i = 1; i < 4; ++i) EXPECT_EQ(reconstructor.process(again)->frame, i);
  EXPECT_EQ(reconstructor.model().points_mm, modelOfFrames(4).points_mm);
}

TEST_F(ProcessOfASequence, KeepsTheIndexOfItsFirstFrame) {
  makeClip(4);
  api::Sequence sequence(at("clip"));
  api::Reconstructor reconstructor = reconstructorOf(sequence);
  reconstructor.recordTo(at("run"));
  sequence.next();
  sequence.next();
  while (reconstructor.process(sequence)) {
  }
  EXPECT_THAT(reconstructor.finish().frames(), ElementsAre(2, 3));
}

TEST_F(ProcessOfASequence, RefusesOtherImagesAndRepeatedFrames) {
  makeClip(3);
  simulateClip(at("larger"), 2, {"scope.width_px=176"});
  simulateClip(at("other"), 3, {"seed=2"});
  api::Sequence sequence(at("clip")), larger(at("larger")), again(at("clip")), other(at("other"));
  api::Reconstructor reconstructor = reconstructorOf(sequence);
  reconstructor.recordTo(at("run"));
  expectError<InputError>([&] { reconstructor.process(larger); },
                          {"sequence, left: is 176 x 120 px", "160 x 120"});
  EXPECT_EQ(reconstructor.process(sequence)->status, "started") << "the model is as it was";
  expectError<OptionError>([&] { reconstructor.process(again); },
                           {"frame 0 comes after frame 0", "new Reconstructor"});
  expectError<OptionError>([&] { reconstructor.process(other); }, {"other files"});
  EXPECT_EQ(reconstructor.process(sequence)->frame, 1);

  api::Reconstructor inside = reconstructorOf(again);
  inside.recordTo(at("clip/left/run"));
  expectError<OptionError>([&] { inside.process(again); }, {"folder of the sequence"});
  EXPECT_FALSE(fs::exists(at("clip/left/run")));
}

// Those after the frames that the queue and the window hold, and that are being read, are missing.
TEST_F(ProcessOfASequence, EndsWhereItsImagesAreDeleted) {
  simulateClip(at("clip"), 20);
  api::Sequence sequence(at("clip"));
  api::Reconstructor reconstructor = reconstructorOf(sequence);
  reconstructor.recordTo(at("run"));
  reconstructor.process(sequence);
  fs::remove_all(at("clip"));
  expectError<InputError>(
      [&] {
        while (reconstructor.process(sequence)) {
        }
      },
      {"was removed", "finish()"});
  EXPECT_GE(reconstructor.finish().frames().size(), 1U);
}

}  // namespace
}  // namespace softscope::test
