// tests/io/video_writer_test.cpp: what is written comes back, nearly.
#include "io/images/video_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <memory>

#include "core/error.h"
#include "io/sequences/picture_source.h"
#include "temporary_folder.h"

namespace softscope {
namespace {

/// A smooth picture whose brightness rises with `index`.
ColourImage made(int index) {
  ColourImage picture(64, 48);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u)
      picture.at(u, v) = {std::uint8_t(60 + u + 10 * index), std::uint8_t(40 + v),
                          std::uint8_t(50 + 5 * index)};
  return picture;
}

int filesIn(const std::filesystem::path& folder) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.exists();
  return count;
}

class VideoWriterTest : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

/// During its lifetime, files cannot exceed this number of bytes: a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(VideoWriterTest, AFullDiskIsAnErrorAndTheFilmThatWasThereStays) {
  const auto file = folder_.path() / "film.mp4";
  for (const bool full : {false, true}) {
    VideoWriter writer(file, 64, 48, 25, /*overwrite=*/true);
    const std::unique_ptr<FullDisk> disk(full ? new FullDisk(600) : nullptr);
    for (int i = 0; i < 6; ++i) writer.add(made(i));
    if (full) {
      EXPECT_THROW(writer.finish(), Error);
    } else {
      writer.finish();
    }
  }
  EXPECT_EQ(openPictures(file)->count(), 6);
  EXPECT_EQ(filesIn(folder_.path()), 1);
}

TEST_F(VideoWriterTest, FramesComeBackInOrderAndNearlyAsTheyWere) {
  const auto file = folder_.path() / "left.mp4";
  VideoWriter writer(file, 64, 48, 25, false);
  for (int i = 0; i < 6; ++i) writer.add(made(i));
  EXPECT_FALSE(std::filesystem::exists(file)) << "not before it is whole";
  writer.finish();
  EXPECT_EQ(filesIn(folder_.path()), 1);
  const auto video = openPictures(file);
  ASSERT_EQ(video->count(), 6);
  EXPECT_NEAR(video->framesPerSecond(), 25, 1e-6);
  for (int i = 0; i < 6; ++i) {
    const ColourImage seen = video->read(i), wanted = made(i);
    double difference = 0;
    for (std::size_t k = 0; k < seen.size(); ++k)
      difference += std::abs(int(seen.values[k].red) - int(wanted.values[k].red));
    // Half resolution of colour and quantisation; neighbouring frames differ by 10.
    EXPECT_LT(difference / double(seen.size()), 4) << i;
  }
}

TEST_F(VideoWriterTest, NothingStaysOfWhatWasNotFinished) {
  {
    VideoWriter writer(folder_.path() / "left.mp4", 64, 48, 25, false);
    writer.add(made(0));
    EXPECT_THROW(writer.add(ColourImage(32, 48)), Error);
  }
  EXPECT_EQ(filesIn(folder_.path()), 0);
}

TEST_F(VideoWriterTest, RefusesToOverwriteAndWhatCannotBeWritten) {
  const auto file = folder_.path() / "left.mp4";
  VideoWriter writer(file, 64, 48, 25, false);
  writer.add(made(0));
  writer.finish();
  EXPECT_THROW(VideoWriter(file, 64, 48, 25, false), OptionError);
  EXPECT_THROW(VideoWriter(folder_.path() / "no/left.mp4", 64, 48, 25, false), Error);
}

}  // namespace
}  // namespace softscope
