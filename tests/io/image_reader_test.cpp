#include "io/images/image_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "io/images/image_codec.h"
#include "io/images/image_header.h"
#include "io/images/image_writer.h"
#include "io/temporary_folder.h"
#include "io/textures.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

cv::Mat bgrTexture(int width = 61, int height = 47) {
  const ColourImage image = makeTexture(width, height);
  cv::Mat bgr;
  cv::cvtColor(matrixView(image, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

class EveryForm : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryForm, ComesBackAsItWas) {
  const std::string bytes = encodeImage(GetParam(), bgrTexture());
  const ColourImage found = parseColourImage(bytes, "x");
  ASSERT_EQ(found.width_px, 61);
  ASSERT_EQ(found.height_px, 47);
  // JPEG at OpenCV's quality 95 changes this noise by 3.5 grey levels; the others nothing.
  const bool lossy = std::string(GetParam()) == ".jpg";
  EXPECT_LE(meanDifference(found, makeTexture(61, 47)), lossy ? 5.0 : 0.0);
}

TEST_P(EveryForm, TruncatedAnywhereIsAnError) {
  const std::string bytes = encodeImage(GetParam(), bgrTexture());
  for (const double share : {0.0, 0.02, 0.3, 0.6, 0.9, 0.99}) {
    const std::string cut =
        bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
    SCOPED_TRACE(share);
    expectError<InputError>([&] { parseColourImage(cut, "cut.file"); }, {"cut.file", "again"});
  }
  expectError<InputError>([&] { parseColourImage(bytes.substr(0, bytes.size() - 1), "cut"); },
                          {"cut"});
}

INSTANTIATE_TEST_SUITE_P(Forms, EveryForm,
                         ::testing::Values(".png", ".jpg", ".bmp", ".tif", ".ppm"));

TEST(ImageReader, ReadsGrayColourAndSixteenBits) {
  const cv::Mat gray(3, 4, CV_8U, cv::Scalar(77)), deep(3, 4, CV_16U, cv::Scalar(77 * 257));
  for (const cv::Mat& image : {gray, deep}) {
    const std::string png = encodeImage(".png", image);
    EXPECT_EQ(parseColourImage(png, "x").at(3, 2), (Rgb8{77, 77, 77}));
    EXPECT_EQ(parseGrayImage(png, "x").at(0, 0), 77);
  }
  EXPECT_EQ(parseGrayImage(encodeImage(".pgm", gray), "x").at(1, 1), 77);
  const cv::Mat red(2, 2, CV_8UC3, cv::Scalar(0, 0, 255));  // BGR
  EXPECT_EQ(parseColourImage(encodeImage(".png", red), "x").at(0, 0), (Rgb8{255, 0, 0}));
  EXPECT_EQ(parseGrayImage(encodeImage(".png", red), "x").at(0, 0), 76);  // 0.299 * 255
}

TEST(ImageReader, AnOrientationTagIsIgnored) {
  // EXIF segment: big endian, one entry, orientation (0x0112) = 6, "turn right".
  const std::string exif(
      "\xFF\xE1\x00\x22"
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0",
      36);
  std::string jpeg = encodeImage(".jpg", bgrTexture());
  jpeg.insert(2, exif);
  const cv::Mat raw(1, static_cast<int>(jpeg.size()), CV_8U, jpeg.data());
  ASSERT_EQ(cv::imdecode(raw, cv::IMREAD_COLOR).cols, 47);  // the tag is there, and would turn it
  EXPECT_EQ(parseColourImage(jpeg, "x").width_px, 61);
}

TEST(ImageReader, DamageInAPngIsFound) {
  std::string png = encodeImage(".png", bgrTexture());
  png[png.size() / 2] = static_cast<char>(png[png.size() / 2] ^ 1);
  expectError<InputError>([&] { parseColourImage(png, "x.png"); },
                          {"x.png", "damaged", "check sum"});
}

TEST(ImageReader, JpegsAreDecodedAsOpenCvDoes) {
  cv::Mat gray;
  cv::cvtColor(bgrTexture(), gray, cv::COLOR_BGR2GRAY);
  for (const cv::Mat& image : {bgrTexture(), bgrTexture(64, 48), bgrTexture(1, 1), gray})
    for (const int progressive : {0, 1}) {
      const std::string jpeg =
          encodeImage(".jpg", image, {cv::IMWRITE_JPEG_PROGRESSIVE, progressive});
      const cv::Mat raw(1, static_cast<int>(jpeg.size()), CV_8U, const_cast<char*>(jpeg.data()));
      EXPECT_EQ(parseColourImage(jpeg, "x").values,
                colourFromBgr(cv::imdecode(raw, cv::IMREAD_COLOR)).values);
    }
}

// libjpeg only warns, and gives a picture that is grey or shifted from the damage on.
TEST(ImageReader, DamageInAJpegIsFoundWhereItsCodesBreak) {
  const std::string jpeg = encodeImage(".jpg", bgrTexture(320, 240));
  std::string zeros = jpeg, cut = jpeg;
  std::fill(zeros.begin() + std::ptrdiff_t(zeros.size() / 2),
            zeros.begin() + std::ptrdiff_t(zeros.size() / 2 + 2000), '\0');
  cut.erase(cut.size() / 2, cut.size() / 3);  // the end is there, the middle isn't
  for (const std::string& damaged : {zeros, cut})
    expectError<InputError>([&] { parseColourImage(damaged, "x.jpg"); },
                            {"x.jpg", "damaged inside", "again"});
  int found = 0;
  for (int i = 1; i <= 40; ++i) {
    std::string flipped = jpeg;
    const std::size_t at = jpeg.size() / 8 + jpeg.size() * std::size_t(i) / 50;
    flipped[at] = char(flipped[at] ^ (1 << i % 8));
    try {
      parseColourImage(flipped, "x.jpg");
    } catch (const InputError&) {
      ++found;
    }
  }
  EXPECT_GE(found, 5) << "one flipped bit leaves valid codes in most cases: 9 of 40 are found";
}

TEST(ImageReader, OtherFilesAreRefused) {
  expectError<InputError>([] { parseColourImage("GIF89a", "x.gif"); }, {"x.gif", "GIF8", "PNG"});
  expectError<InputError>([] { parseColourImage("", "x"); }, {"empty"});
  TemporaryFolder folder;
  expectError<InputError>([&] { readColourImage(folder / "none.png"); }, {"none.png"});
}

TEST(ImageReader, AbsurdSizesAreRefusedBeforeDecoding) {
  expectError<InputError>([] { parseColourImage("P5 60000 60000 255\n", "x.pgm"); },
                          {"60000 x 60000"});
  expectError<InputError>([] { parseColourImage("P5 0 5 255\n", "x.pgm"); }, {"0 x 5"});
  expectError<InputError>([] { parseColourImage("P5 99999999999 5 255\n", "x.pgm"); }, {"damaged"});
  // 16000 x 16000 are within a side's limit, but not the area's.
  expectError<InputError>([] { parseColourImage("P6 16000 16000 255\n", "x.ppm"); }, {"16000"});
}

TEST(ImageReader, MasksCountWhatIsNotZero) {
  cv::Mat mask(2, 3, CV_8U, cv::Scalar(0));
  mask.at<unsigned char>(1, 2) = 1;
  const Mask found = parseMask(encodeImage(".png", mask), "x");
  EXPECT_EQ(found.at(2, 1), 255);
  EXPECT_EQ(found.at(0, 0), 0);
  cv::Mat colour(2, 3, CV_8UC3, cv::Scalar(0, 0, 0));
  colour.at<cv::Vec3b>(0, 1)[2] = 9;
  EXPECT_EQ(parseMask(encodeImage(".png", colour), "x").at(1, 0), 255);
  const cv::Mat opaque(2, 3, CV_8UC4, cv::Scalar(0, 0, 0, 255));  // alpha is ignored
  EXPECT_EQ(parseMask(encodeImage(".png", opaque), "x").at(1, 1), 0);
  const cv::Mat faint(2, 3, CV_16U, cv::Scalar(1));  // would vanish in 8 bits
  EXPECT_EQ(parseMask(encodeImage(".png", faint), "x").at(1, 1), 255);
  const cv::Mat ringing(16, 16, CV_8U, cv::Scalar(5));
  EXPECT_EQ(parseMask(encodeImage(".jpg", ringing), "x").at(1, 1), 0);
}

TEST(ImageWriter, WritesPngJpegAndSixteenBits) {
  TemporaryFolder folder;
  const ColourImage image = makeTexture(20, 10);
  writePng(folder / "c.png", image);
  EXPECT_EQ(meanDifference(readColourImage(folder / "c.png"), image), 0);
  writePng(folder / "g.png", toGray(image));
  EXPECT_EQ(readGrayImage(folder / "g.png").values, toGray(image).values);
  Raster<std::uint16_t> deep(5, 4, 54321);
  writePng(folder / "d.png", deep);
  EXPECT_EQ(cv::imread((folder / "d.png").string(), cv::IMREAD_UNCHANGED).at<std::uint16_t>(3, 4),
            54321);
  writeJpeg(folder / "j.jpg", image);
  EXPECT_LT(meanDifference(readColourImage(folder / "j.jpg"), image), 4);
  expectError<OptionError>([&] { writePng(folder / "c.png", image); }, {"c.png", "`overwrite=`"});
  writePng(folder / "c.png", makeTexture(7, 7), true);
  EXPECT_EQ(readColourImage(folder / "c.png").width_px, 7);
  expectError<OptionError>([&] { writeJpeg(folder / "k.jpg", image, 0); }, {"quality"});
}

TEST(ImageReader, ReadsTheDevelopmentData) {
  SOFTSCOPE_DATA_OR_SKIP(data, "opencas_ct");
  const ColourImage left = readColourImage(data / "left.png");
  EXPECT_EQ(left.width_px, 720);
  EXPECT_EQ(left.height_px, 576);
  const Mask mask = readMask(data / "Stereo_SD_d_complete_22_MASK_eval.png");
  EXPECT_TRUE(mask.sameShape(left));
  EXPECT_EQ(readColourImage(dataFolder("openhelp_heart/left/000000.jpg")).width_px, 640);
  EXPECT_EQ(readGrayImage(dataFolder("libelas_pairs/cones_left.pgm")).width_px, 900);
}

}  // namespace
}  // namespace softscope::test
