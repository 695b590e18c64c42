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

/// Bits of a parameter set, most significant first.
class BitWriter {
 public:
  BitWriter& bits(std::uint32_t value, int count) {
    for (int bit = count - 1; bit >= 0; --bit) text_ += (value >> bit & 1) != 0 ? '1' : '0';
    return *this;
  }
  /// Exponential-Golomb code.
  BitWriter& golomb(std::uint32_t value) {
    int length = 1;
    while ((value + 1) >> length != 0) ++length;
    return bits(0, length - 1).bits(value + 1, length);
  }
  std::string bytes() const {
    std::string all;
    for (std::size_t at = 0; at < text_.size(); at += 8)
      all +=
          static_cast<char>(std::stoi((text_.substr(at, 8) + "10000000").substr(0, 8), nullptr, 2));
    return all;
  }

 private:
  std::string text_;
};

/// ITU-T H.264, 7.3.2.1.1: high profile, `rows` of macroblocks (of pairs where `interlaced`), the
/// last `crop` steps of rows hidden.
std::string avcOf1920(std::uint32_t rows, bool interlaced, std::uint32_t crop) {
  BitWriter set;
  set.bits(100, 8).bits(0, 8).bits(40, 8).golomb(0);  // profile, level, id
  set.golomb(1).golomb(0).golomb(0).bits(0, 2);       // 4:2:0, 8 bits
  set.golomb(0).golomb(2).golomb(4).bits(0, 1);       // numbers and order of frames
  set.golomb(119).golomb(rows - 1).bits(interlaced ? 0 : 1, 1);
  if (interlaced) set.bits(0, 1);
  set.bits(1, 1).bits(1, 1).golomb(0).golomb(0).golomb(0).golomb(crop).bits(0, 1).bits(1, 1);
  return std::string("\0\0\0\1\x67", 5) + set.bytes();
}

TEST(VideoFrameSize, IsThatOfThePictureAndNotOfItsCodedRows) {
  for (const bool interlaced : {false, true}) {
    const auto size =
        statedFrameSize(interlaced ? avcOf1920(34, true, 2) : avcOf1920(68, false, 4), "avc1");
    ASSERT_TRUE(size);
    EXPECT_EQ(size->width_px, 1920);
    EXPECT_EQ(size->height_px, 1080) << "coded as 1088 rows";
  }
  EXPECT_EQ(statedFrameSize(avcOf1920(68, false, 0), "avc1")->height_px, 1088);
  EXPECT_FALSE(statedFrameSize(avcOf1920(68, false, 600), "avc1")) << "nothing is left";
  // ITU-T H.265, 7.3.2.2.1: one layer, 1920 x 1088, 4 steps of rows hidden.
  BitWriter set;
  set.bits(0, 4).bits(0, 3).bits(1, 1);
  for (int i = 0; i < 12; ++i) set.bits(0x11, 8);
  set.golomb(0).golomb(1).golomb(1920).golomb(1088).bits(1, 1);
  set.golomb(0).golomb(0).golomb(0).golomb(4).bits(1, 1);
  const auto size = statedFrameSize(std::string("\0\0\1\x42\1", 5) + set.bytes(), "hvc1");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->height_px, 1080);
}

TEST(VideoSource, FramesThatChangeSizeAreAnErrorFromThereOn) {
  const TemporaryFolder folder;
  put(folder / "v.avi",
      avi({jpeg(96, 80, 50), jpeg(96, 80, 100), jpeg(128, 96, 150), jpeg(96, 80, 200)}, 96, 80));
  const auto video = openPictures(folder / "v.avi");
  ASSERT_EQ(video->count(), 4);
  EXPECT_NEAR(video->read(0).at(5, 5).red, 50, 3);
  EXPECT_NEAR(video->read(1).at(5, 5).red, 100, 3);
  expectError<InputError>([&] { video->read(2); }, {"v.avi", "96 x 80 to 128 x 96 px at frame 2",
                                                    "`frames=` 0:2", "ffmpeg"});
}

TEST(VideoSource, FramesOfOneSizeAreRead) {
  const TemporaryFolder folder;
  put(folder / "v.avi", avi({jpeg(96, 80, 50), jpeg(96, 80, 100), jpeg(96, 80, 150)}, 96, 80));
  const auto video = openPictures(folder / "v.avi");
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(video->read(i).at(5, 5).red, 50 * (i + 1), 3);
}

}  // namespace
}  // namespace softscope::test
