// tests/toolkit/view_faults_test.cpp: causes of missing depth, named by info, depth, reconstruct.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "io/images/orientation_tag.h"
#include "support/in_folder.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"
#include "toolkit/inspection/describe_path.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class ViewFaults : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    makeSequence("s", 1);
  }
  std::string view(const std::string& side) const { return at("s/" + side + "/000000.png"); }
  /// Each value times `gain`.
  void dim(const std::string& side, double gain) const {
    ColourImage image = readColourImage(view(side));
    const auto dimmed = [gain](std::uint8_t value) {
      return static_cast<std::uint8_t>(gain * value);
    };
    for (Rgb8& pixel : image.values)
      pixel = {dimmed(pixel.red), dimmed(pixel.green), dimmed(pixel.blue)};
    writePng(view(side), image, /*overwrite=*/true);
  }
  void exchange() const {
    fs::rename(at("s/left"), at("s/other"));
    fs::rename(at("s/right"), at("s/left"));
    fs::rename(at("s/other"), at("s/right"));
  }
  /// Every command names `cause`.
  void expectNamed(const std::string& cause, bool by_info = true) const {
    if (by_info) {
      EXPECT_THAT(describePath(at("s")).text(), HasSubstr(cause));
    }
    Told measured, fused;
    EXPECT_THROW(measureSequence(measurement(at("s"), at("depth")), measured.listener()),
                 InputError);
    EXPECT_THAT(measured.failures, Contains(HasSubstr(cause)));
    EXPECT_THROW(reconstructSequence(reconstruction(at("s"), at("run")), fused.listener()),
                 InputError);
    EXPECT_THAT(fused.warnings, Contains(HasSubstr(cause)));
  }
};

TEST_F(ViewFaults, ExchangedFoldersAreNamed) {
  exchange();
  expectNamed("the views match when exchanged: give the views in the other order");
}

TEST_F(ViewFaults, ExchangedPartsOfOneImageAreNamed) {
  exchange();
  const ColourImage left = readColourImage(view("left")), right = readColourImage(view("right"));
  ColourImage both(2 * left.width_px, left.height_px);
  for (int v = 0; v < left.height_px; ++v) {
    std::copy_n(left.row(v), left.width_px, both.row(v));
    std::copy_n(right.row(v), left.width_px, both.row(v) + left.width_px);
  }
  writePng(at("both.png"), both);
  MeasureOptions options;
  options.sequence.stereo = at("both.png");
  options.sequence.calibration = at("s/calibration.yaml");
  options.name = "both.png";
  options.out = at("depth");
  Told told;
  EXPECT_THROW(measureSequence(options, told.listener()), InputError);
  EXPECT_THAT(told.failures, Contains(HasSubstr("set sequence.right_first=true")));
}

TEST_F(ViewFaults, BlackImagesAreNamed) {
  for (const char* side : {"left", "right"}) dim(side, 0);
  expectNamed("the images are black: mean 0.0, largest value 0 of 255");
}

TEST_F(ViewFaults, DataOfTenBitsAreNamed) {
  for (const char* side : {"left", "right"}) dim(side, 1 / 64.0);
  expectNamed("(16-bit files must use all 16 bits: scale 10- or 12-bit data)");
}

TEST_F(ViewFaults, OneBlackImageIsNamed) {
  dim("right", 0);
  expectNamed("the right image is black");
}

TEST_F(ViewFaults, AMaskThatHidesTheImageIsNamed) {
  fs::create_directory(at("s/mask"));
  writePng(at("s/mask/000000.png"), Mask(160, 120, 255));
  expectNamed("the mask hides 100 % of the image: non-zero pixels are ignored; is it inverted?");
}

TEST_F(ViewFaults, SoundViewsHaveNone) {
  EXPECT_THAT(describePath(at("s")).text(), Not(HasSubstr("Measured: ")));
  dim("right", 0.9);
  EXPECT_THAT(describePath(at("s")).text(), Not(HasSubstr("brightness")));
}

/// A JPEG's start with an Exif segment of one field.
std::string withTag(char orientation, bool little_endian) {
  const std::string tiff = little_endian
                               ? std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18) +
                                     std::string{orientation, 0, 0, 0}
                               : std::string("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01", 18) +
                                     std::string{0, orientation, 0, 0};
  const std::string content = std::string("Exif\0\0", 6) + tiff;
  return std::string("\xff\xd8\xff\xe0\0\x04xx\xff\xe1\0", 11) + char(content.size() + 2) +
         content + "\xff\xda";
}

TEST(OrientationTag, IsReadInBothByteOrders) {
  for (const bool little_endian : {true, false})
    for (char tag = 1; tag <= 8; ++tag)
      EXPECT_EQ(parseOrientationTag(withTag(tag, little_endian)), tag);
  EXPECT_EQ(parseOrientationTag(withTag(9, true)), 1);
}

TEST(OrientationTag, IsOneForDamagedOrOtherFiles) {
  const std::string whole = withTag(6, true);
  for (std::size_t size = 0; size < 40; ++size)
    EXPECT_EQ(parseOrientationTag(whole.substr(0, size)), size < 38 ? 1 : 6) << size;
  EXPECT_EQ(parseOrientationTag("\x89PNG"), 1);
  EXPECT_EQ(orientationTag("nowhere.jpg"), 1);
}

TEST_F(ViewFaults, AnIgnoredOrientationIsNamed) {
  exchange();
  for (const char* side : {"left", "right"}) {
    writeJpeg(at(std::string("s/") + side + "/000000.jpg"), readColourImage(view(side)));
    fs::remove(view(side));
  }
  const std::string plain = textOf(at("s/left/000000.jpg"));
  const std::string start = withTag(3, true);
  write("s/left/000000.jpg", start.substr(0, start.size() - 2) + plain.substr(2));
  expectNamed("000000.jpg has the orientation tag 3, which is ignored");
}

TEST_F(ViewFaults, AModelOfFewPointsIsNoModel) {
  fs::create_directory(at("s/depth"));
  Raster<float> depth_mm(160, 120, std::numeric_limits<float>::quiet_NaN());
  for (int v = 50; v < 62; ++v) std::fill_n(depth_mm.row(v) + 70, 12, 50.0F);
  writePfm(at("s/depth/000000.pfm"), depth_mm);
  Told told;
  ReconstructOptions small = reconstruction(at("s"), at("run"));
  set({"gate.min_coverage=0.001"}, &small.settings);
  const auto run = reconstructSequence(small, told.listener());
  const std::string few = "fewer than 1 % of the 19200 pixels";
  EXPECT_THAT(told.warnings, Contains(HasSubstr(few)));
  EXPECT_THAT(written(run.record)["warnings"].dump(), HasSubstr(few));
  makeSequence("whole", 1);
  Told silent;
  reconstructSequence(reconstruction(at("whole"), at("whole_run")), silent.listener());
  EXPECT_THAT(silent.warnings, Not(Contains(HasSubstr("no model of the tissue"))));
}

}  // namespace
}  // namespace softscope::test
