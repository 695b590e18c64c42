// tests/io/video_frame_size_test.cpp: sizes of packets, and videos whose frames change size.
#include "io/sequences/video_frame_size.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "io/images/video_writer.h"
#include "io/sequences/picture_source.h"
#include "temporary_folder.h"

namespace softscope::test {
namespace {

std::string jpeg(int width_px, int height_px, int brightness) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", cv::Mat(height_px, width_px, CV_8UC3, cv::Scalar::all(brightness)), bytes);
  return {bytes.begin(), bytes.end()};
}

std::string little(std::initializer_list<std::uint32_t> numbers) {
  std::string bytes;
  for (const std::uint32_t number : numbers)
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

std::string chunk(const std::string& name, const std::string& data) {
  return name + little({static_cast<std::uint32_t>(data.size())}) + data +
         std::string(data.size() % 2, '\0');
}

/// Motion JPEG in AVI, 25 frames per second.
std::string avi(const std::vector<std::string>& frames, std::uint32_t width_px,
                std::uint32_t height_px) {
  const auto count = static_cast<std::uint32_t>(frames.size());
  const std::string head =
      little({40000, 0, 0, 16, count, 0, 1, 0, width_px, height_px, 0, 0, 0, 0});
  const std::string stream =
      "vidsMJPG" + little({0, 0, 0, 1, 25, 0, count, 0, 0, 0, 0, width_px | height_px << 16});
  const std::string format =
      little({40, width_px, height_px, 1 | 24 << 16}) + "MJPG" + little({0, 0, 0, 0, 0});
  std::string movie = "movi", index;
  for (const std::string& frame : frames) {
    index += "00dc" + little({16, static_cast<std::uint32_t>(movie.size()),
                              static_cast<std::uint32_t>(frame.size())});
    movie += chunk("00dc", frame);
  }
  const std::string streams = chunk("LIST", "strl" + chunk("strh", stream) + chunk("strf", format));
  return chunk("RIFF", "AVI " + chunk("LIST", "hdrl" + chunk("avih", head) + streams) +
                           chunk("LIST", movie) + chunk("idx1", index));
}

TEST(VideoFrameSize, StandsInEachJpeg) {
  const auto size = statedFrameSize(jpeg(96, 80, 100), "MJPG");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width_px, 96);
  EXPECT_EQ(size->height_px, 80);
  EXPECT_FALSE(statedFrameSize(jpeg(96, 80, 100).substr(0, 20), "MJPG")) << "cut before it";
  EXPECT_FALSE(statedFrameSize("", "MJPG"));
}

TEST(VideoFrameSize, StandsInTheParameterSetsOfH264AndHevc) {
  using namespace std::string_literals;
  // Baseline profile, 20 x 15 macroblocks: seq_parameter_set_rbsp of ITU-T H.264.
  const std::string avc = "\0\0\0\1\x67\x42\xc0\x0d\xf4\x0a\x0f\xc8"s;
  const auto size = statedFrameSize(avc, "avc1");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width_px, 320);
  EXPECT_EQ(size->height_px, 240);
  // One layer: seq_parameter_set_rbsp of ITU-T H.265, 320 x 240.
  const std::string hevc =
      "\0\0\1\x42\1\x01\x11\x11\x11\x11\x11\x11\x11\x11\x11\x11\x11\x11\xa0\x0a\x08\x0f\x10"s;
  const auto same = statedFrameSize(hevc, "hvc1");
  ASSERT_TRUE(same);
  EXPECT_TRUE(*same == *size);
  EXPECT_FALSE(statedFrameSize("\0\0\1\x65\x88"s, "avc1")) << "a picture alone";
  EXPECT_FALSE(statedFrameSize("\0\0\1\x67"s, "avc1")) << "cut";
  EXPECT_FALSE(statedFrameSize(avc, "VP90")) << "another codec";
}

TEST(VideoSource, FramesThatChangeSizeAreAnErrorFromThereOn) {
  const TemporaryFolder folder;
  put(folder / "v.avi",
      avi({jpeg(96, 80, 50), jpeg(96, 80, 100), jpeg(128, 96, 150), jpeg(96, 80, 200)}, 96, 80));
  const auto video = openPictures(folder / "v.avi");
  ASSERT_EQ(video->count(), 4);
  EXPECT_NEAR(video->read(0).at(5, 5).red, 50, 3);
  EXPECT_NEAR(video->read(1).at(5, 5).red, 100, 3);
  expectError<InputError>([&] { video->read(2); },
                          {"v.avi", "96 x 80 to 128 x 96 px at frame 2", "--frames 0:2", "ffmpeg"});
}

TEST(VideoSource, FramesOfOneSizeAreRead) {
  const TemporaryFolder folder;
  put(folder / "v.avi", avi({jpeg(96, 80, 50), jpeg(96, 80, 100), jpeg(96, 80, 150)}, 96, 80));
  const auto video = openPictures(folder / "v.avi");
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(video->read(i).at(5, 5).red, 50 * (i + 1), 3);
}

}  // namespace
}  // namespace softscope::test
