// tests/toolkit/inspection_test.cpp: content of files and folders.
#include <gmock/gmock.h>

#include <cmath>

#include "io/geometry/depth_files.h"
#include "io/images/image_writer.h"
#include "support/data_folder.h"
#include "support/in_folder.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"
#include "toolkit/calibration/calibration_template.h"
#include "toolkit/inspection/describe_path.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Inspection : public InFolder {
 protected:
  static Json described(const std::string& path, const DescribeOptions& options = {}) {
    return written(describePath(path, options).json());
  }
};

TEST_F(Inspection, ASequenceTellsItsCalibrationAndWhatIsMissing) {
  const std::string sequence = makeSequence("s", 2);
  write("s/timestamps.txt", "0.0\n0.04\n");
  const Json json = described(sequence);
  EXPECT_EQ(json["kind"], "sequence");
  EXPECT_EQ(json["frames"], 2);
  EXPECT_EQ(json["width_px"], 160);
  EXPECT_DOUBLE_EQ(json["calibration"]["baseline_mm"], 5);
  EXPECT_DOUBLE_EQ(json["calibration"]["left"]["fx_px"], 140);
  EXPECT_NEAR(json["calibration"]["depth_of_1px_at_50mm_mm"], 50 * 50 / (140 * 5.0), 1e-9);
  EXPECT_NEAR(json["calibration"]["field_of_view_deg"][0], 2 * std::atan(80 / 140.0) * 180 / M_PI,
              1e-6);
  EXPECT_NEAR(json["duration_s"], 0.04, 1e-9);
  EXPECT_LT(json["mean_row_difference_px"], 0.5);
  EXPECT_THAT(json["missing"].dump(), HasSubstr("mask/"));
  EXPECT_TRUE(json["problems"].empty());
}

TEST_F(Inspection, ASequenceWithoutCalibrationStillTellsWhatThereIs) {
  const std::string sequence = makeSequence("s", 2);
  fs::remove(sequence + "/calibration.yaml");
  const FactSheet facts = describePath(sequence);
  EXPECT_TRUE(facts.hasProblems());
  const Json json = written(facts.json());
  EXPECT_EQ(json["left_pictures"], 2);
  EXPECT_THAT(json["problems"].dump(), HasSubstr("calibration"));
}

TEST_F(Inspection, EveryTemplateOfACalibrationReadsAsItIs) {
  for (const std::string& kind : calibrationTemplateNames()) {
    const FactSheet facts = describePath(write(kind + ".yaml", calibrationTemplate(kind)));
    EXPECT_FALSE(facts.hasProblems()) << kind << facts.text();
    const Json json = written(facts.json());
    EXPECT_TRUE(json["warnings"].empty()) << kind << facts.text();
    EXPECT_DOUBLE_EQ(json["left"]["fx_px"], 520);
    EXPECT_EQ(json.contains("baseline_mm"), kind != "rgb-d");
  }
  EXPECT_THAT(calibrationTemplateNames(), testing::ElementsAre("stereo", "rectified", "rgb-d"));
  expectError<OptionError>([] { calibrationTemplate("rectifed"); }, {"did you mean `rectified`?"});
}

TEST_F(Inspection, CheckReadsEveryFrame) {
  const std::string sequence = makeSequence("s", 3);
  fs::resize_file(sequence + "/left/000002.png", 200);
  EXPECT_FALSE(described(sequence).contains("unreadable_frames"));
  DescribeOptions all;
  all.check_all = true;
  const FactSheet checked = describePath(sequence, all);
  EXPECT_TRUE(checked.hasProblems());
  const Json json = written(checked.json());
  EXPECT_EQ(json["unreadable_frames"], 1);
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("000002.png"));
}

TEST_F(Inspection, ExchangedViewsAreNoticed) {
  const std::string sequence = makeSequence("s", 1);
  fs::rename(sequence + "/left", sequence + "/tmp");
  fs::rename(sequence + "/right", sequence + "/left");
  fs::rename(sequence + "/tmp", sequence + "/right");
  EXPECT_THAT(describePath(sequence).text(), HasSubstr("not exchanged?"));
}

TEST_F(Inspection, AMissingNumberIsMentioned) {
  const std::string sequence = makeSequence("s", 5);
  EXPECT_THAT(describePath(sequence).text(), Not(HasSubstr("numbers in both views")));
  for (const char* side : {"/left", "/right"}) fs::remove(sequence + side + "/000002.png");
  EXPECT_THAT(describePath(sequence).text(),
              HasSubstr("images of 1 numbers in both views, the first is 2"));
}

TEST_F(Inspection, AViewThatStandsStillIsNoticed) {
  simulateClip(at("clip"), 3);
  fs::copy_file(at("clip/right/000001.png"), at("clip/right/000002.png"),
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(describePath(at("clip")).text(), HasSubstr("warning: frame 2: the right image"));
  DescribeOptions all;
  all.check_all = true;
  EXPECT_EQ(written(describePath(at("clip"), all).json())["frames_with_bad_views"], 1);
}

TEST_F(Inspection, APictureTellsItsSizeAndBrightness) {
  writePng(at("p.png"), ColourImage(64, 48, {200, 100, 100}));
  const Json json = described(at("p.png"));
  EXPECT_EQ(json["kind"], "image");
  EXPECT_EQ(json["width_px"], 64);
  EXPECT_TRUE(json["colour"]);
  EXPECT_DOUBLE_EQ(json["mean_gray"], 130);  // 0.299 * 200 + 0.701 * 100, rounded
}

TEST_F(Inspection, AFloatMapTellsItsValues) {
  Raster<float> depth_mm(4, 4, std::nanf(""));
  depth_mm.values[3] = 51.5f;
  writePfm(at("d.pfm"), depth_mm);
  const Json json = described(at("d.pfm"));
  EXPECT_DOUBLE_EQ(json["coverage"], 1 / 16.0);
  EXPECT_DOUBLE_EQ(json["median"], 51.5);
}

TEST_F(Inspection, ASettingsFileIsCheckedKeyByKey) {
  const std::string good = write("good.toml", "[stereo]\nmethod = \"sgbm\"\n");
  const FactSheet fine = describePath(good);
  EXPECT_FALSE(fine.hasProblems());
  EXPECT_THAT(fine.text(), HasSubstr("sgbm (default elas)"));
  const std::string bad = write("bad.toml", "[stereo]\nmethd = \"sgbm\"\nborder_px = \"wide\"\n");
  const FactSheet wrong = describePath(bad);
  EXPECT_TRUE(wrong.hasProblems());
  EXPECT_EQ(wrong.json()["problems"].size(), 2u);
}

TEST_F(Inspection, ACalibrationIsSummarised) {
  const std::string sequence = makeSequence("s", 1);
  const Json json = described(sequence + "/calibration.yaml");
  EXPECT_EQ(json["kind"], "calibration");
  EXPECT_EQ(json["form"], "OpenCV");
  EXPECT_TRUE(json["rectified"]);
}

TEST_F(Inspection, AMeshTellsItsBoxAndWhetherItIsClosed) {
  const std::string tetrahedron =
      "# SPACE=RAS\nv 0 0 0\nv 30 0 0\nv 0 40 0\nv 0 0 50\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const Json json = described(write("t.obj", tetrahedron));
  EXPECT_EQ(json["kind"], "mesh");
  EXPECT_EQ(json["vertices"], 4);
  EXPECT_EQ(json["triangles"], 4);
  EXPECT_TRUE(json["closed"]);
  EXPECT_EQ(json["space"], "RAS");
  EXPECT_EQ(json["size_mm"][2], 50);
  EXPECT_NEAR(json["volume_mm3"], 30 * 40 * 50 / 6.0, 0.1);
}

TEST_F(Inspection, AMeshInMetresIsSuspected) {
  const std::string small =
      "v 0 0 0\nv 0.12 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  EXPECT_THAT(describePath(write("m.obj", small)).text(), HasSubstr("metres"));
}

TEST_F(Inspection, PointsOfDepthAreDescribed) {
  const std::string sequence = makeSequence("s", 1);
  MeasureOptions cloud = measurement(sequence, at("out"));
  cloud.kinds = DepthOutputKinds::parse("cloud");
  const Json depth = written(measureSequence(cloud).record);
  const Json json = described(at("out/000000_cloud.ply"));
  EXPECT_EQ(json["kind"], "points");
  EXPECT_EQ(json["points"], depth["frames"][0]["points"]);
  EXPECT_GT(json["box_low_mm"][2], 30);
  EXPECT_LT(json["box_high_mm"][2], 70);
  fs::resize_file(at("out/000000_cloud.ply"), fs::file_size(at("out/000000_cloud.ply")) - 1);
  expectError<InputError>([&] { described(at("out/000000_cloud.ply")); }, {"000000_cloud.ply"});
}

TEST_F(Inspection, AnAsciiCloudIsReadAsWell) {
  const std::string ply = write("a.ply",
                                "ply\nformat ascii 1.0\ncomment mm, left frame\nelement vertex 3\n"
                                "property float x\nproperty float y\nproperty float z\n"
                                "end_header\n1 2 3\n4 nan 9\n1e12 0 0\n");
  const Json json = described(ply);
  EXPECT_EQ(json["points"], 3);
  EXPECT_EQ(json["box_high_mm"][2], 3);
  EXPECT_THAT(json["comments"].dump(), HasSubstr("left frame"));
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("2 points"));
}

TEST_F(Inspection, AVolumeTellsWhereItLies) {
  const std::string voxels(48, '\1');
  const std::string file =
      write("v.mha",
            "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
            "BinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
            "Offset = 1 2 3\nElementSpacing = 5 6 7\nDimSize = 12 2 1\n"
            "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                voxels);
  const Json json = described(file);
  EXPECT_EQ(json["kind"], "volume");
  EXPECT_EQ(json["axes"], "LPS");
  EXPECT_EQ(json["origin_lps_mm"][2], 3);
}

TEST_F(Inspection, UnknownThingsAreInputErrorsThatSayWhatIsAccepted) {
  const std::string strange = write("x.docx", "letter");
  const std::string empty = write("empty.png", "");
  fs::create_directories(at("folder"));
  for (const std::string& path : {strange, empty, at("folder"), at("absent")})
    expectError<InputError>([&] { described(path); }, {path});
  expectError<InputError>([&] { described(strange); }, {"nii.gz"});
}

TEST_F(Inspection, PatientFieldsComeOnlyWhenAsked) {
  SOFTSCOPE_DATA_OR_SKIP(data, "ct");
  EXPECT_FALSE(described(data / "chaos_dicom").contains("patient"));
  DescribeOptions named;
  named.volume.with_patient = true;
  EXPECT_TRUE(described(data / "chaos_dicom", named).contains("patient"));
}

}  // namespace
}  // namespace softscope::test
