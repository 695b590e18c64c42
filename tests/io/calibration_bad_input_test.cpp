// tests/io/calibration_bad_input_test.cpp: calibrations that must be refused, or accepted with a
// warning.
#include <gtest/gtest.h>

#include "io/calibration_texts.h"
#include "io/calibrations/calibration_check.h"
#include "io/calibrations/calibration_reader.h"
#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The YAML with one change must cause an InputError that contains all `parts`.
void expectRefused(const std::string& from, const std::string& to,
                   const std::vector<std::string>& parts) {
  SCOPED_TRACE(from + " → " + to);
  expectError<InputError>([&] { parseCalibration(replaced(openCvYaml(), from, to), "c.yaml"); },
                          parts);
}

TEST(BadCalibration, FocalLengthMustBeAPositiveNumber) {
  expectRefused("500,0,321", ".Nan,0,321", {"c.yaml", "M1", "nan", "Calibrate"});
  expectRefused("500,0,321", "0,0,321", {"c.yaml", "left camera", "fx is 0", "positive"});
  expectRefused("500,0,321", "-500,0,321", {"left camera", "-500"});
  expectRefused("505,239", ".Inf,239", {"M2", "inf"});
}

TEST(BadCalibration, NumbersBeyondAnyPictureAreDamaged) {
  expectRefused("500,0,321", "4294967296,0,321", {"c.yaml: the left camera", "fx", "up to 1e+06"});
  expectRefused("500,0,321", "500,0,4294967296",
                {"c.yaml: the left camera", "principal point", "16384"});
  expectRefused("505,239", "505,-1e12", {"the right camera", "principal point"});
}

TEST(BadCalibration, ALensThatMovesTheEdgeBeyondThePictureIsDamaged) {
  expectRefused("-0.1,0.02", "-0.1,4294967296", {"c.yaml: the left camera", "lens moves the edge"});
  expectRefused("-0.11,0.03", "-1e9,0.03", {"the right camera", "640 x 480"});
}

TEST(BadCalibration, BaselineInAnotherUnitIsGuessed) {
  const std::string size = "image_width: 640\nimage_height: 480\n";
  expectError<InputError>(
      [&] { parseCalibration(openCvYaml(size, "-0.0042 0 0"), "c.yaml"); },
      {"c.yaml: the baseline is 0.0042 mm, but an endoscope's is 1 to 20 mm. In "
       "metres? Then write `unit: m`"});
  expectError<InputError>(
      [&] { parseCalibration(openCvYaml(size + "unit: m\n", "-4.2 0 0"), "c.yaml"); },
      {"4200 mm", "In millimetres? Then write `unit: mm`"});
  expectError<InputError>([&] { parseCalibration(openCvYaml(size, "0 0 0"), "c.yaml"); }, {"0 mm"});
  expectError<InputError>([&] { parseCalibration(openCvYaml(size, "-120 0 0"), "c.yaml"); },
                          {"120 mm"});
}

TEST(BadCalibration, TheUnitIsGuessedForBaselinesOf2To8Mm) {
  const std::string size = "image_width: 640\nimage_height: 480\n";
  const auto centimetres = parseCalibration(openCvYaml(size, "-0.52 0 0"), "c").warnings;
  ASSERT_EQ(centimetres.size(), 1U);
  EXPECT_NE(centimetres[0].find("In centimetres? Then write `unit: cm`"), std::string::npos)
      << centimetres[0];
  expectError<InputError>([&] { parseCalibration(openCvYaml(size, "-5200 0 0"), "c.yaml"); },
                          {"5200 mm", "In micrometres? Then divide T by 1000"});
  for (const char* none : {"-0.09 0 0", "-120 0 0"})
    expectError<InputError>([&] { parseCalibration(openCvYaml(size, none), "c.yaml"); },
                            {"Calibrate again, or give its length"});
}

TEST(BadCalibration, UnusualBaselinesWarn) {
  const std::string size = "image_width: 640\nimage_height: 480\n";
  for (const char* t : {"-0.5 0 0", "-40 0 0"}) {
    const auto found = parseCalibration(openCvYaml(size, t), "c");
    ASSERT_EQ(found.warnings.size(), 1U) << t;
    EXPECT_NE(found.warnings[0].find("baseline"), std::string::npos);
  }
}

TEST(BadCalibration, TheRightCameraMustBeOnTheRight) {
  const std::string size = "image_width: 640\nimage_height: 480\n";
  expectError<InputError>([&] { parseCalibration(openCvYaml(size, "5 0 0"), "c.yaml"); },
                          {"right camera lies at", "exchanged"});
  const std::string plain =
      replaced(openCvYaml(size, "5.2 0 0"), commas(kRotation), "1,0,0,0,1,0,0,0,1");
  expectError<InputError>([&] { parseCalibration(plain, "c.yaml"); }, {"(-5.2, 0, 0) mm"});
  expectError<InputError>([&] { parseCalibration(openCvYaml(size, "-1 5 0"), "c.yaml"); },
                          {"right camera lies at"});
}

TEST(BadCalibration, RMustBeARotation) {
  expectRefused(commas(kRotation), "1,0,0,0,1,0,0,0,1.1", {"R is no rotation", "0.21"});
  expectRefused(commas(kRotation), "1,0,0,0,1,0,0,0,-1", {"R is no rotation", "determinant -1"});
  expectRefused(commas(kRotation), "1,0,0,0,nan,0,0,0,1", {"R holds nan"});
  // Four digits, as some files have them, are made a rotation again.
  const auto rounded = parseCalibration(
      replaced(openCvYaml(), commas(kRotation), "0.9999,0,-0.0100,0,1,0,0.0100,0,0.9999"), "c");
  const Eigen::Matrix3d r = rounded.right_from_left.linear();
  EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(BadCalibration, RectifiedMustBeTrue) {
  const std::string head = "image_width: 640\nimage_height: 480\nrectified: 1\n";
  expectError<InputError>([&] { parseCalibration(openCvYaml(head), "c.yaml"); },
                          {"rectified", "distortion", "rectified: 0"});
  std::string plain = openCvYaml(head);
  plain = replaced(plain, "-0.1,0.02,0.001,-0.002,0.003", "0,0,0,0,0");
  plain = replaced(plain, "-0.11,0.03,0.002,-0.001,0.004", "0,0,0,0,0");
  expectError<InputError>([&] { parseCalibration(plain, "c.yaml"); }, {"R turns by 0.57"});
  plain = replaced(plain, commas(kRotation), "1,0,0,0,1,0,0,0,1");
  expectError<InputError>([&] { parseCalibration(plain, "c.yaml"); }, {"focal lengths differ"});
  plain = replaced(plain, "502,0,318,0,505,239", "500,0,318,0,500,230");
  expectError<InputError>([&] { parseCalibration(plain, "c.yaml"); }, {"cy differs", "241", "230"});
  EXPECT_TRUE(parseCalibration(replaced(plain, "500,230", "500,241"), "c").rectified);
  expectError<InputError>(
      [&] { parseCalibration(replaced(plain, "rectified: 1", "rectified: maybe"), "c.yaml"); },
      {"maybe", "0 or 1"});
}

TEST(BadCalibration, UnusualViewsWarn) {
  const auto warningsFor = [](const std::string& size) {
    return parseCalibration(openCvYaml(size), "c").warnings;
  };
  // f 500 on 120 px sees 14°, on 3000 px 143°; the principal point leaves the middle as well.
  for (const char* size :
       {"image_width: 120\nimage_height: 480\n", "image_width: 3000\nimage_height: 480\n"}) {
    const auto warnings = warningsFor(size);
    ASSERT_EQ(warnings.size(), 4U) << size;
    EXPECT_NE(warnings[0].find("°"), std::string::npos);
    EXPECT_NE(warnings[1].find("principal point"), std::string::npos);
  }
  const auto stretched =
      parseCalibration(replaced(openCvYaml(), "500,0,321,0,500", "500,0,321,0,250"), "c").warnings;
  ASSERT_EQ(stretched.size(), 1U);
  EXPECT_NE(stretched[0].find("fx / fy is 2"), std::string::npos);
}

TEST(BadCalibration, AnAssumedSizeMustFitThePrincipalPoints) {
  const auto warningsFor = [](double left_u, double right_u, double v) {
    StereoCalibration calibration = parseCalibration(openCvYaml(), "c");
    calibration.left.pinhole.cx_px = left_u;
    calibration.right.pinhole.cx_px = right_u;
    calibration.left.pinhole.cy_px = calibration.right.pinhole.cy_px = v;
    return checkAssumedSize(calibration);
  };
  // 800 x 600 and 480 x 360 on 640 x 480.
  for (const double scale : {1.25, 0.75}) {
    const double u = 320 * scale - 0.5, v = 240 * scale - 0.5;
    const auto warnings = warningsFor(u + 4, u - 4, v);
    ASSERT_EQ(warnings.size(), 1U) << scale;
    EXPECT_NE(warnings[0].find(scale > 1 ? "800 x 600" : "480 x 360"), std::string::npos)
        << warnings[0];
  }
  EXPECT_TRUE(warningsFor(330, 310, 250).empty());
  EXPECT_TRUE(warningsFor(400, 240, 300).empty()) << "cameras that look past each other";
  EXPECT_TRUE(warningsFor(400, 400, 200).empty()) << "towards another corner";
  EXPECT_TRUE(warningsFor(460, 460, 290).empty()) << "by different factors";
}

TEST(BadCalibration, CoefficientsInTheOrderOfMatlabWarn) {
  const auto warningsFor = [](const std::string& lens) {
    return parseCalibration(replaced(openCvYaml(), "-0.1,0.02,0.001,-0.002,0.003", lens), "c")
        .warnings;
  };
  for (const char* lens : {"-0.25,0.12,-0.05,0.0015,-0.001", "-0.25,0.12,0.001,0.05,-0.001"}) {
    const auto warnings = warningsFor(lens);
    ASSERT_EQ(warnings.size(), 1U) << lens;
    EXPECT_NE(warnings[0].find("c: the left camera's p"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[0].find("order is k1 k2 p1 p2 k3"), std::string::npos) << warnings[0];
  }
  EXPECT_TRUE(warningsFor("-0.25,0.12,0.015,-0.019,-0.05").empty());
}

TEST(BadCalibration, AbsurdSizesAndUnitsAreRefused) {
  expectRefused("image_width: 640", "image_width: 640000", {"640000 x 480"});
  expectRefused("image_width: 640", "image_width: 640.5", {"image_width", "640.5", "whole"});
  expectRefused("image_width: 640", "image_width: many", {"image_width", "many"});
  expectRefused("image_width: 640", "depth_unit_mm: 0\nimage_width: 640", {"depth_unit_mm is 0"});
}

TEST(BadCalibration, MatricesMustHaveTheirShape) {
  expectRefused("rows: 3", "rows: 4", {"M1", "`4` x `3`", "holds 9"});
  expectRefused("500,0,321,0,500,241,0,0,1", "500,0,0,0,500,0,321,241,1",
                {"M1", "third row is 321 241 1", "transposed"});
  expectRefused("500,0,321", "500,7,321", {"M1", "skew of 7"});
  expectRefused("cols: 5", "cols: 1", {"D1"});
  const std::string d1 = "rows: 1\n   cols: 5\n   dt: d\n   data: [ -0.1,0.02,0.001,-0.002,0.003 ]";
  expectRefused(d1, "rows: 1\n   cols: 3\n   dt: d\n   data: [ 1, 2, 3 ]",
                {"D1 has 3 numbers", "4, 5, 8 or 12"});
  expectRefused(d1, "rows: 1\n   cols: 14\n   data: [ 0,0,0,0,0,0,0,0,0,0,0,0,0.1,0 ]",
                {"D1", "tilt"});
  expectRefused("500,0,321", "five,0,321", {"M1", "five"});
  expectRefused("M1: !!opencv-matrix", "A1: !!opencv-matrix", {"M1 is missing", "stereoCalibrate"});
}

TEST(BadCalibration, OtherFormsAreCheckedAsWell) {
  expectError<InputError>([] { parseCalibration("RAT\n3\n1 2 3\n", "x.txt"); }, {"x.txt", "RAT"});
  expectError<InputError>(
      [] { parseCalibration(replaced(openCas(), "0.4 0.5 0.6", "0.4"), "x.txt"); },
      {"x.txt: left camera (line 4) has 29 numbers", "31"});
  expectError<InputError>([] { parseCalibration(kHamlynLeft + kHamlynRight, "x.txt"); },
                          {"x.txt", "8 lines of numbers", "12"});
  expectError<InputError>(
      [] { parseCalibration(replaced(scaredJson(), "\"KR\"", "\"KX\""), "f.json"); },
      {"f.json: M2 is missing"});
  expectError<InputError>([] { parseCalibration(scaredJson().substr(0, 200), "f.json"); },
                          {"f.json", "JSON"});
  expectError<InputError>([] { parseCalibration(openCvXml().substr(0, 400), "f.xml"); },
                          {"f.xml", "line"});
  expectError<InputError>([] { parseCalibration("{\"M1\": [1e999]}", "f.json"); },
                          {"f.json", "number"});
  expectError<InputError>([] { parseCalibration("", "f"); }, {"empty"});
  expectError<InputError>([] { parseCalibration("\x93NUMPY\x01", "f.npy"); }, {"f.npy"});
  CalibrationHints hints;
  hints.baseline_mm = 5;
  const std::string npy = endoNerfNpy();
  expectError<InputError>([&] { parseCalibration(npy.substr(0, npy.size() - 9), "f.npy", hints); },
                          {"f.npy", "promises"});
  std::string two = endoNerfNpy(2);
  two.replace(two.size() - 17 * 8, 17 * 8,
              endoNerfNpy(1, 700).substr(endoNerfNpy(1).size() - 17 * 8));
  expectError<InputError>([&] { parseCalibration(two, "f.npy", hints); },
                          {"another camera", "700"});
}

TEST(BadCalibration, MisspeltKeysAreNamed) {
  const std::string size = "image_width: 640\nimage_height: 480\n";
  const auto expectWarning = [](const std::string& text, const std::string& part) {
    const auto warnings = parseCalibration(text, "c").warnings;
    ASSERT_EQ(warnings.size(), 1U) << part;
    EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
  };
  const std::string few = "f: 500\ncx: 321\ncy: 241\n";
  expectWarning(few + "baseline: 5\ncx_rigth: 330\n",
                "c: `cx_rigth` is not a known key; is `cx_right` meant?");
  expectWarning(few + "baselin: 5\n", "is `baseline` meant?");
  expectWarning(few + "baseline: 5\ndistortion: [0.1, 0, 0, 0]\n",
                "without distortion; `distortion` is not read");
  expectWarning(openCvYaml("image_widht: 640\nimage_height: 480\n"), "is `image_width` meant?");
  expectWarning(openCvYaml(size + "rectifed: 1\n"), "is `rectified` meant?");
  expectWarning(openCvYaml(size + "Unit: m\n"), "is `unit` meant?");
  expectWarning(
      replaced(openCvYaml(size), "D1: !!", "distortion1: !!"),
      "D1 or D2 is missing; the lens is taken to be without distortion. Not read: `distortion1`");
  expectError<InputError>(
      [&] { parseCalibration(replaced(openCvYaml(size), "M1: !!", "cameraMatrx1: !!"), "c"); },
      {"c: M1 is missing", "`cameraMatrx1` is not a known key; is `cameraMatrix1` meant?"});
}

TEST(BadCalibration, KeysOfOtherProgramsAreSilent) {
  const std::string size = "image_width: 640\nimage_height: 480\n";
  for (const char* key :
       {"calibration_time", "board_width", "square_size", "nframes", "flags", "P1", "Q", "E",
        "R_left", "P_left", "cameraMatrix3", "image_time", "avg_reprojection_error", "distance"})
    EXPECT_TRUE(parseCalibration(openCvYaml(size + key + ": 1\n"), "c").warnings.empty()) << key;
}

TEST(BadCalibration, MatricesOfKittiAreNotThoseOfServCt) {
  const std::string left = "500 0 321 0 0 500 241 0 0 0 1 0\n",
                    right = "500 0 321 -2500 0 500 241 0 0 0 1 0\n";
  const std::string pair = "P1: " + left + "P2: " + right;
  EXPECT_EQ(parseCalibration(pair, "c").form, "SERV-CT");
  expectError<InputError>(
      [&] {
        parseCalibration("P0: " + left + "P1: " + right + "P2: " + left + "P3: " + right, "c.txt");
      },
      {"c.txt: P0 and P1 are names of KITTI", "calibration-template rectified"});
}

TEST(BadCalibration, AFisheyeLensIsRefusedWhereverItIsNamed) {
  for (const char* line :
       {"distortion_model: equidistant", "Distortion_Model: Kannala-Brandt", "model: fisheye",
        "camera_model: OPENCV_FISHEYE", "lens_type: kb4", "fisheye: 1", "is_fisheye: true",
        "distortion_model: division", "left: {distortion_model: equidistant}"}) {
    const std::string head = "image_width: 640\nimage_height: 480\n" + std::string(line) + "\n";
    SCOPED_TRACE(line);
    expectError<InputError>([&] { parseCalibration(openCvYaml(head), "c.yaml"); },
                            {"c.yaml: ", "plumb_bob", "fisheye models are not read", "Calibrate"});
  }
  expectError<InputError>([] { parseCalibration("f: 5\ncx: 3\ncy: 2\nmodel: fisheye\n", "c"); },
                          {"c: model is `fisheye`"});
  expectError<InputError>(
      [] { parseCalibration("[StereoLeft]\ndistortion_model=equidistant\n", "c.ini"); },
      {"c.ini: distortion_model is `equidistant`"});
  for (const char* line : {"distortion_model: plumb_bob", "distortion_model: Rational Polynomial",
                           "model: Olympus LTF-S190", "camera_model: pinhole", "fisheye: 0",
                           "lens_type: 30 degrees", "distortion_type: [1, 2]"}) {
    const std::string head = "image_width: 640\nimage_height: 480\n" + std::string(line) + "\n";
    EXPECT_TRUE(parseCalibration(openCvYaml(head), "c").warnings.empty()) << line;
  }
}

TEST(BadCalibration, RosWithoutBaselineOrWithAFisheyeIsRefused) {
  TemporaryFolder folder;
  const std::string camera = "500 0 321 0 500 241 0 0 1", lens = "0 0 0 0 0",
                    identity = "1 0 0 0 1 0 0 0 1";
  put(folder / "left.yaml", rosYaml(camera, lens, identity, "0"));
  put(folder / "right.yaml", rosYaml(camera, lens, identity, "0"));
  expectError<InputError>([&] { readCalibration(folder.path()); },
                          {"right camera", "-fx * baseline"});
  put(folder / "right.yaml",
      replaced(rosYaml(camera, lens, identity, "-2.1"), "plumb_bob", "equidistant"));
  expectError<InputError>([&] { readCalibration(folder.path()); }, {"equidistant", "plumb_bob"});
  // -fx * baseline in mm: a thousand times too long.
  put(folder / "right.yaml", rosYaml(camera, lens, identity, "-2100"));
  expectError<InputError>([&] { readCalibration(folder.path()); }, {"In millimetres?"});
}

}  // namespace
}  // namespace softscope::test
