// tests/apps/test_info.cpp: `softscope info` knows what it is shown.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "io/geometry/depth_files.h"
#include "io/images/image_writer.h"
#include "support/data_folder.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Info : public InFolder {};

TEST_F(Info, ASequenceTellsItsCalibrationAndWhatIsMissing) {
  const std::string sequence = makeSequence("s", 2);
  write("s/timestamps.txt", "0.0\n0.04\n");
  const Outcome outcome = run({"info", sequence, "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
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

TEST_F(Info, ASequenceWithoutCalibrationStillTellsWhatThereIs) {
  const std::string sequence = makeSequence("s", 2);
  fs::remove(sequence + "/calibration.yaml");
  const Outcome outcome = run({"info", sequence, "--json"});
  EXPECT_EQ(outcome.exit_code, 3);
  const auto json = outcome.json();
  EXPECT_EQ(json["left_pictures"], 2);
  EXPECT_THAT(json["problems"].dump(), HasSubstr("calibration"));
}

TEST_F(Info, EveryTemplateOfACalibrationReadsAsItIs) {
  for (const char* kind : {"stereo", "rectified", "rgb-d"}) {
    const std::string file = at(std::string(kind) + ".yaml");
    const Outcome written = run({"calibration-template", kind, "--out", file});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_THAT(written.err, HasSubstr("written: " + file));
    const Outcome outcome = run({"info", file, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << kind << outcome.err;
    EXPECT_TRUE(outcome.json()["warnings"].empty()) << kind << outcome.out;
    EXPECT_DOUBLE_EQ(outcome.json()["left"]["fx_px"], 520);
    EXPECT_EQ(outcome.json().contains("baseline_mm"), std::string(kind) != "rgb-d");
    EXPECT_EQ(run({"calibration-template", kind}).out, textOf(file)) << "comments and all";
  }
  const Outcome wrong = run({"calibration-template", "rectifed"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean `rectified`?"));
}

TEST_F(Info, CheckReadsEveryFrame) {
  const std::string sequence = makeSequence("s", 3);
  fs::resize_file(sequence + "/left/000002.png", 200);
  EXPECT_FALSE(run({"info", sequence, "--json"}).json().contains("unreadable_frames"));
  const Outcome checked = run({"info", sequence, "--check", "--json"});
  EXPECT_EQ(checked.exit_code, 3);
  const auto json = checked.json();
  EXPECT_EQ(json["unreadable_frames"], 1);
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("000002.png"));
}

TEST_F(Info, ExchangedViewsAreNoticed) {
  const std::string sequence = makeSequence("s", 1);
  fs::rename(sequence + "/left", sequence + "/tmp");
  fs::rename(sequence + "/right", sequence + "/left");
  fs::rename(sequence + "/tmp", sequence + "/right");
  EXPECT_THAT(run({"info", sequence}).out, HasSubstr("not exchanged?"));
}

TEST_F(Info, APictureTellsItsSizeAndBrightness) {
  writePng(at("p.png"), ColourImage(64, 48, {200, 100, 100}));
  const auto json = run({"info", at("p.png"), "--json"}).json();
  EXPECT_EQ(json["kind"], "image");
  EXPECT_EQ(json["width_px"], 64);
  EXPECT_TRUE(json["colour"]);
  EXPECT_DOUBLE_EQ(json["mean_gray"], 130);  // 0.299 * 200 + 0.701 * 100, rounded
}

TEST_F(Info, AFloatMapTellsItsValues) {
  Raster<float> depth_mm(4, 4, std::nanf(""));
  depth_mm.values[3] = 51.5f;
  writePfm(at("d.pfm"), depth_mm);
  const auto json = run({"info", at("d.pfm"), "--json"}).json();
  EXPECT_DOUBLE_EQ(json["coverage"], 1 / 16.0);
  EXPECT_DOUBLE_EQ(json["median"], 51.5);
}

TEST_F(Info, ASettingsFileIsCheckedKeyByKey) {
  const std::string good = write("good.toml", "[stereo]\nmethod = \"sgbm\"\n");
  const Outcome fine = run({"info", good});
  EXPECT_EQ(fine.exit_code, 0);
  EXPECT_THAT(fine.out, HasSubstr("sgbm (default elas)"));
  const std::string bad = write("bad.toml", "[stereo]\nmethd = \"sgbm\"\nborder_px = \"wide\"\n");
  const Outcome wrong = run({"info", bad, "--json"});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_EQ(wrong.json()["problems"].size(), 2u);
}

TEST_F(Info, ACalibrationIsSummarised) {
  const std::string sequence = makeSequence("s", 1);
  const auto json = run({"info", sequence + "/calibration.yaml", "--json"}).json();
  EXPECT_EQ(json["kind"], "calibration");
  EXPECT_EQ(json["form"], "OpenCV");
  EXPECT_TRUE(json["rectified"]);
}

TEST_F(Info, AMeshTellsItsBoxAndWhetherItIsClosed) {
  const std::string tetrahedron =
      "# SPACE=RAS\nv 0 0 0\nv 30 0 0\nv 0 40 0\nv 0 0 50\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const auto json = run({"info", write("t.obj", tetrahedron), "--json"}).json();
  EXPECT_EQ(json["kind"], "mesh");
  EXPECT_EQ(json["vertices"], 4);
  EXPECT_EQ(json["triangles"], 4);
  EXPECT_TRUE(json["closed"]);
  EXPECT_EQ(json["space"], "RAS");
  EXPECT_EQ(json["size_mm"][2], 50);
  EXPECT_NEAR(json["volume_mm3"], 30 * 40 * 50 / 6.0, 0.1);
}

TEST_F(Info, AMeshInMetresIsSuspected) {
  const std::string small =
      "v 0 0 0\nv 0.12 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  EXPECT_THAT(run({"info", write("m.obj", small)}).out, HasSubstr("metres"));
}

TEST_F(Info, PointsOfDepthAreDescribed) {
  const std::string sequence = makeSequence("s", 1);
  const auto depth = run({"depth", sequence, "--out", at("out"), "--write", "cloud", "--json"});
  const Outcome outcome = run({"info", at("out/000000_cloud.ply"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json["kind"], "points");
  EXPECT_EQ(json["points"], depth.json()["frames"][0]["points"]);
  EXPECT_GT(json["box_low_mm"][2], 30);
  EXPECT_LT(json["box_high_mm"][2], 70);
  fs::resize_file(at("out/000000_cloud.ply"), fs::file_size(at("out/000000_cloud.ply")) - 1);
  EXPECT_EQ(run({"info", at("out/000000_cloud.ply")}).exit_code, 3);
}

TEST_F(Info, AnAsciiCloudIsReadAsWell) {
  const std::string ply = write("a.ply",
                                "ply\nformat ascii 1.0\ncomment mm, left frame\nelement vertex 3\n"
                                "property float x\nproperty float y\nproperty float z\n"
                                "end_header\n1 2 3\n4 nan 9\n1e12 0 0\n");
  const auto json = run({"info", ply, "--json"}).json();
  EXPECT_EQ(json["points"], 3);
  EXPECT_EQ(json["box_high_mm"][2], 3);
  EXPECT_THAT(json["comments"].dump(), HasSubstr("left frame"));
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("2 points"));
}

TEST_F(Info, AVolumeTellsWhereItLies) {
  const std::string voxels(48, '\1');
  const std::string file =
      write("v.mha",
            "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
            "BinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
            "Offset = 1 2 3\nElementSpacing = 5 6 7\nDimSize = 12 2 1\n"
            "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                voxels);
  const auto json = run({"info", file, "--json"}).json();
  EXPECT_EQ(json["kind"], "volume");
  EXPECT_EQ(json["axes"], "LPS");
  EXPECT_EQ(json["origin_lps_mm"][2], 3);
}

TEST_F(Info, UnknownThingsAreInputErrorsThatSayWhatIsAccepted) {
  const std::string strange = write("x.docx", "letter");
  const std::string empty = write("empty.png", "");
  fs::create_directories(at("folder"));
  for (const std::string& path : {strange, empty, at("folder"), at("absent")}) {
    const Outcome outcome = run({"info", path});
    EXPECT_EQ(outcome.exit_code, 3) << path;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(path));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_THAT(run({"info", strange}).err, HasSubstr("nii.gz"));
}

TEST_F(Info, LibrariesAddNothingToOurError) {
  // An MP4's data without its table: "moov atom not found", FFmpeg would say.
  const char bytes[] =
      "\0\0\0\x18"
      "ftypmp42\0\0\0\0mp42isom\0\0\0\x10"
      "mdat12345678";
  const std::string video = write("v.mp4", {bytes, sizeof bytes - 1});
  const Outcome outcome = run({"info", video});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::StartsWith("error: " + video));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(Info, PatientFieldsComeOnlyWhenAsked) {
  SOFTSCOPE_DATA_OR_SKIP(data, "ct");
  EXPECT_FALSE(run({"info", data / "chaos_dicom", "--json"}).json().contains("patient"));
  EXPECT_TRUE(
      run({"info", data / "chaos_dicom", "--json", "--patient"}).json().contains("patient"));
}

}  // namespace
}  // namespace softscope::test
