#include "io/calibrations/calibration_reader.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "io/calibration_texts.h"
#include "io/calibrations/calibration_writer.h"
#include "io/calibrations/one_camera.h"
#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

constexpr double kRounding = 1e-12;  // numbers pass through text with 17 digits

void expectCamera(const RawCamera& camera, double fx, double fy, double cx, double cy, double k1) {
  EXPECT_DOUBLE_EQ(camera.pinhole.fx_px, fx);
  EXPECT_DOUBLE_EQ(camera.pinhole.fy_px, fy);
  EXPECT_DOUBLE_EQ(camera.pinhole.cx_px, cx);
  EXPECT_DOUBLE_EQ(camera.pinhole.cy_px, cy);
  EXPECT_DOUBLE_EQ(camera.distortion.coefficients[0], k1);
}

/// The rig of calibration_texts.h.
void expectTheRig(const StereoCalibration& found) {
  expectCamera(found.left, 500, 500, 321, 241, -0.1);
  expectCamera(found.right, 502, 505, 318, 239, -0.11);
  EXPECT_DOUBLE_EQ(found.left.distortion.coefficients[3], -0.002);
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(-0.01, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_LT((found.right_from_left.linear() - turned).norm(), kRounding);
  EXPECT_LT((found.right_from_left.translation() - Eigen::Vector3d(-5, 0.02, 0.03)).norm(),
            kRounding);
  EXPECT_FALSE(found.rectified);
}

void expectSize(const StereoCalibration& found, int width, int height) {
  EXPECT_EQ(found.left.pinhole.width_px, width);
  EXPECT_EQ(found.right.pinhole.width_px, width);
  EXPECT_EQ(found.left.pinhole.height_px, height);
  EXPECT_EQ(found.right.pinhole.height_px, height);
}

TEST(CalibrationReader, ReadsOpenCvYaml) {
  const auto found = parseCalibration(openCvYaml(), "c.yaml");
  expectTheRig(found);
  expectSize(found, 640, 480);
  EXPECT_EQ(found.form, "OpenCV");
  EXPECT_EQ(found.source, "c.yaml");
  EXPECT_TRUE(found.warnings.empty());
  EXPECT_DOUBLE_EQ(found.depth_unit_mm, 0.01);
}

TEST(CalibrationReader, SkipsTheByteOrderMarkOfUtf8) {
  const std::string mark = "\xef\xbb\xbf";
  TemporaryFolder folder;
  const std::vector<std::pair<const char*, std::string>> files = {
      {"c.yaml", openCvYaml()},
      {"c.xml", openCvXml()},
      {"c.json", scaredJson()},
      {"c.txt", openCas()},
      {"h.txt", kHamlynLeft + kHamlynRight + kHamlynPose}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    expectTheRig(parseCalibration(mark + text, name));
    put(folder / name, mark + text);
    expectTheRig(readCalibration(folder / name));
  }
  put(folder / "only" / "pair.txt", mark + openCas());
  EXPECT_EQ(readCalibration(folder / "only").form, "OpenCAS");
  put(folder / "utf16.yaml", std::string("\xff\xfe", 2) + std::string("f\0:\0", 4));
  expectError<InputError>([&] { readCalibration(folder / "utf16.yaml"); },
                          {"utf16.yaml: its text is UTF-16, but UTF-8 is expected"});
}

TEST(CalibrationReader, ARectifiedPairNeedsFourNumbers) {
  const auto found =
      parseCalibration("f: 500\ncx: 321\ncy: 241\nbaseline: 0.5\nunit: cm\n", "c.yaml");
  expectCamera(found.left, 500, 500, 321, 241, 0);
  expectCamera(found.right, 500, 500, 321, 241, 0);
  EXPECT_DOUBLE_EQ(found.baseline_mm(), 5);
  EXPECT_TRUE(found.rectified);
  EXPECT_FALSE(hasOneCamera(found));
  EXPECT_TRUE(found.warnings.empty());
  expectError<InputError>([] { parseCalibration("f: 500\ncy: 241\nbaseline: 5\n", "c.yaml"); },
                          {"c.yaml: cx", "is missing", "calibration-template"});
  expectError<InputError>(
      [] { parseCalibration("f: 500\ncx: 321\ncy: 241\nbaseline: 0.005\n", "c.yaml"); },
      {"In metres?"});
}

TEST(CalibrationReader, FewNumbersMustBeFinite) {
  for (const char* text :
       {"f: 500\ncx: .nan\ncy: 241\nbaseline: 5\n", "f: 500\ncx: 321\ncy: .inf\n",
        "f: 500\ncx: 321\ncy: 241\nbaseline: 5\ncx_right: .nan\n",
        "f: 500\ncx: 321\ncy: 241\nbaseline: .nan\n", "f: 0\ncx: 321\ncy: 241\n"})
    expectError<InputError>([&] { parseCalibration(text, "c.yaml"); }, {"c.yaml"});
}

TEST(CalibrationReader, OneCameraIsEnoughForDepth) {
  for (const char* text : {"fx: 500\nfy: 500\ncx: 321\ncy: 241\ndepth_unit_mm: 1\n",
                           "K: [500, 0, 321, 0, 500, 241, 0, 0, 1]\ndepth_unit_mm: 1\n"}) {
    const auto found = parseCalibration(text, "c.yaml");
    expectCamera(found.left, 500, 500, 321, 241, 0);
    EXPECT_TRUE(hasOneCamera(found)) << text;
    EXPECT_TRUE(found.rectified);
    EXPECT_DOUBLE_EQ(found.depth_unit_mm, 1);
  }
}

TEST(CalibrationReader, ReadsOpenCvXml) {
  const auto found = parseCalibration(openCvXml(), "c.xml");
  expectTheRig(found);
  expectSize(found, 640, 480);
}

TEST(CalibrationReader, ReadsWhatOpenCvItselfWrites) {
  for (const char* kind : {"c.yaml", "c.xml", "c.json"}) {
    cv::FileStorage storage(kind, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    const cv::Mat k1 = (cv::Mat_<double>(3, 3) << 500, 0, 321, 0, 500, 241, 0, 0, 1);
    const cv::Mat k2 = (cv::Mat_<double>(3, 3) << 502, 0, 318, 0, 505, 239, 0, 0, 1);
    const cv::Mat d1 = (cv::Mat_<double>(5, 1) << -0.1, 0.02, 0.001, -0.002, 0.003);
    const cv::Mat d2 = (cv::Mat_<double>(1, 5) << -0.11, 0.03, 0.002, -0.001, 0.004);
    const double c = 0.99995000041666528, s = 0.0099998333341666645;
    const cv::Mat r = (cv::Mat_<double>(3, 3) << c, 0, -s, 0, 1, 0, s, 0, c);
    const cv::Mat t = (cv::Mat_<double>(3, 1) << -5, 0.02, 0.03);
    storage << "image_width" << 640 << "image_height" << 480 << "cameraMatrix1" << k1
            << "distCoeffs1" << d1 << "cameraMatrix2" << k2 << "distCoeffs2" << d2 << "R" << r
            << "T" << t;
    SCOPED_TRACE(kind);
    expectTheRig(parseCalibration(storage.releaseAndGetString(), kind));
  }
}

TEST(CalibrationReader, ReadsNestedListsAndARotationVector) {
  const std::string text =
      "KL:\n- - 500\n  - 0\n  - 321\n- [0, 500, 241]\n- [0, 0, 1]\n"
      "KR: [[502, 0, 318], [0, 505, 239], [0, 0, 1]]\nDL: [-0.1, 0.02, 0.001, -0.002]\n"
      "DR: {rows: 1, cols: 4, data: [-0.11, 0.03, 0.002, -0.001]}\n"
      "R: [0, -0.01, 0]\nT: [-5, 0.02, 0.03]\nimage_size: [640, 480]\n";
  const auto found = parseCalibration(text, "c.yaml");
  expectTheRig(found);
  expectSize(found, 640, 480);
}

TEST(CalibrationReader, UnderstandsUnitRectifiedAndDepthUnit) {
  const std::string head = "image_width: 640\nimage_height: 480\ndepth_unit_mm: 0.1\nunit: ";
  const auto metres = parseCalibration(openCvYaml(head + "m\n", "-0.005 0 0"), "c");
  EXPECT_DOUBLE_EQ(metres.baseline_mm(), 5);
  EXPECT_DOUBLE_EQ(metres.depth_unit_mm, 0.1);
  EXPECT_DOUBLE_EQ(parseCalibration(openCvYaml(head + "cm\n", "-0.5 0 0"), "c").baseline_mm(), 5);
  expectError<InputError>([&] { parseCalibration(openCvYaml(head + "inch\n"), "c"); },
                          {"inch", "mm, cm or m"});
}

TEST(CalibrationReader, ReadsScaredJsonAndYaml) {
  const auto json = parseCalibration(scaredJson(), "frame_data.json");
  expectTheRig(json);
  EXPECT_EQ(json.form, "SCARED");
  expectSize(json, 0, 0);  // determined by the images
  const auto yaml = parseCalibration(openCvYaml(""), "keyframe_1/endoscope_calibration.yaml");
  expectTheRig(yaml);
  EXPECT_EQ(yaml.form, "SCARED");
}

TEST(CalibrationReader, ReadsJsonThatWasWrittenOverManyLines) {
  std::string pretty;  // one number per line, as in json.dump(..., indent=2)
  for (const char c : scaredJson()) {
    if (c == ']') pretty += '\n';
    pretty += c;
    if (c == '[' || c == '{' || c == ',') pretty += "\n  ";
  }
  const auto json = parseCalibration(pretty, "frame_data.json");
  expectTheRig(json);
  EXPECT_EQ(json.form, "SCARED");
}

TEST(CalibrationReader, ReadsOpenCasWithTheWholeRationalModel) {
  const auto found = parseCalibration(openCas(), "x_Calibration.txt");
  expectTheRig(found);
  expectSize(found, 640, 480);
  EXPECT_EQ(found.form, "OpenCAS");
  EXPECT_DOUBLE_EQ(found.left.distortion.coefficients[7], 0.6);
  EXPECT_DOUBLE_EQ(found.right.distortion.coefficients[5], 0.7);
}

TEST(CalibrationReader, PrefersTheOpenCasFileAndWarnsOfTheSplitForm) {
  TemporaryFolder folder;
  const std::string pose =
      "0.99995000041666528 0 -0.0099998333341666645 -5\n0 1 0 0.02\n"
      "0.0099998333341666645 0 0.99995000041666528 0.03\n0 0 0 1\n";
  put(folder / "calib.left.intrinsics.txt", "500 0 321\n0 500 241\n0 0 1\n");
  put(folder / "calib.right.intrinsics.txt", "502 0 318\n0 505 239\n0 0 1\n");
  put(folder / "calib.left.distortion.txt", "-0.1 0.02 0.001 -0.002 0.003\n");
  put(folder / "calib.right.distortion.txt", "-0.11 0.03 0.002 -0.001 0.004\n");
  put(folder / "calib.l2r.txt", pose);
  const auto split = readCalibration(folder.path());
  expectTheRig(split);
  ASSERT_FALSE(split.warnings.empty());
  EXPECT_NE(split.warnings[0].find("rational"), std::string::npos);

  put(folder / "pair_Calibration.txt", openCas());
  const auto whole = readCalibration(folder.path());
  EXPECT_DOUBLE_EQ(whole.left.distortion.coefficients[5], 0.4);
  EXPECT_TRUE(whole.warnings.empty());
  // Naming a part asks for the parts.
  EXPECT_DOUBLE_EQ(
      readCalibration(folder / "calib.left.intrinsics.txt").left.distortion.coefficients[5], 0);
}

TEST(CalibrationReader, AMissingHalfOfTheRationalModelIsNotCalledDamage) {
  TemporaryFolder folder;
  for (const std::string side : {"left", "right"}) {
    put(folder / ("calib." + side + ".intrinsics.txt"), "500 0 321\n0 500 241\n0 0 1\n");
    put(folder / ("calib." + side + ".distortion.txt"), "-0.7 120 0.001 -0.002 -19\n");
  }
  put(folder / "calib.l2r.txt", "1 0 0 -5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_EQ(readCalibration(folder.path()).form, "OpenCAS");
  CalibrationHints hints;
  hints.image_size = "640x480";
  const std::string text = expectError<InputError>(
      [&] { readCalibration(folder / "calib.l2r.txt", hints); },
      {"left camera's lens moves the edge", "k4 k5 k6, is missing", "one-file form"});
  EXPECT_EQ(text.find("damaged"), std::string::npos) << text;
}

TEST(CalibrationReader, ReadsHamlynFromThreeFilesAndFromOne) {
  TemporaryFolder folder;
  put(folder / "Left_Camera_Calibration_Intrinsic.txt", kHamlynLeft);
  put(folder / "Right_Camera_Calibration_Intrinsic.txt", kHamlynRight);
  put(folder / "camera_extrinsic.txt", kHamlynPose);
  const auto three = readCalibration(folder.path());
  expectTheRig(three);
  EXPECT_EQ(three.form, "Hamlyn");
  expectTheRig(readCalibration(folder / "camera_extrinsic.txt"));
  const std::string one = "Left camera\n" + kHamlynLeft + "\nRight camera\n" + kHamlynRight +
                          "\nRotation and translation\n" + kHamlynPose;
  const auto joined = parseCalibration(one, "camera_calibration.txt");
  expectTheRig(joined);
  EXPECT_EQ(joined.form, "Hamlyn");
}

TEST(CalibrationReader, ReadsOpenCvIntrinsicsAndExtrinsicsAsOne) {
  TemporaryFolder folder;
  const std::string all = openCvYaml();
  const std::size_t pose = all.find("R: !!");
  put(folder / "intrinsics.yml", all.substr(0, pose));
  put(folder / "extrinsics.yml", "%YAML:1.0\n---\n" + all.substr(pose));
  expectTheRig(readCalibration(folder.path()));
  expectTheRig(readCalibration(folder / "extrinsics.yml"));
}

/// Rectification turns the left camera by +0.01 rad and the right one by -0.02 about y, and the
/// right one sits 4.2 mm to the right in the rectified frame.
TEST(CalibrationReader, TurnsRosRectificationIntoPoseAndMetresIntoMm) {
  TemporaryFolder folder;
  const auto about_y = [](double angle_rad) {
    return Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  };
  const auto text = [](const Eigen::Matrix3d& m) {
    std::ostringstream out;
    out.precision(17);
    for (int i = 0; i < 9; ++i) out << (i ? " " : "") << m(i / 3, i % 3);
    return out.str();
  };
  const Eigen::Matrix3d left = about_y(0.01), right = about_y(-0.02);
  put(folder / "left.yaml",
      rosYaml("500 0 321 0 500 241 0 0 1", "-0.1 0.02 0.001 -0.002 0.003", text(left), "0"));
  put(folder / "right.yaml",
      rosYaml("502 0 318 0 505 239 0 0 1", "-0.11 0.03 0.002 -0.001 0.004", text(right), "-2.142"));
  const auto found = readCalibration(folder.path());
  EXPECT_EQ(found.form, "ROS");
  expectSize(found, 640, 480);
  expectCamera(found.left, 500, 500, 321, 241, -0.1);
  expectCamera(found.right, 502, 505, 318, 239, -0.11);
  EXPECT_LT((found.right_from_left.linear() - right.transpose() * left).norm(), kRounding);
  EXPECT_NEAR(found.baseline_mm(), 4.2, 1e-9);  // 2.142 m px / 510 px
  // A point on the rectified axis is in the same row and 4.2 mm apart in both.
  const Eigen::Vector3d p_left(1, 2, 80);
  const Eigen::Vector3d difference = right * (found.right_from_left * p_left) - left * p_left;
  EXPECT_LT((difference - Eigen::Vector3d(-4.2, 0, 0)).norm(), 1e-9);

  CalibrationHints rectified;
  rectified.rectified = true;
  const auto ideal = readCalibration(folder / "right.yaml", rectified);
  EXPECT_TRUE(ideal.rectified);
  expectCamera(ideal.left, 510, 510, 320, 240, 0);
  EXPECT_NEAR(ideal.right_from_left.translation().x(), -4.2, 1e-9);
}

TEST(CalibrationReader, ReadsEndoNerfOnceTheBaselineIsGiven) {
  expectError<InputError>([] { parseCalibration(endoNerfNpy(), "poses_bounds.npy"); },
                          {"poses_bounds.npy", "baseline", "calibration.baseline_mm"});
  CalibrationHints hints;
  hints.baseline_mm = 4.324;
  const auto found = parseCalibration(endoNerfNpy(), "poses_bounds.npy", hints);
  EXPECT_EQ(found.form, "EndoNeRF");
  EXPECT_TRUE(found.rectified);
  expectCamera(found.left, 500, 500, 320, 240, 0);
  expectSize(found, 640, 480);
  EXPECT_DOUBLE_EQ(found.right_from_left.translation().x(), -4.324);
}

TEST(CalibrationReader, HintsFillInAndScale) {
  CalibrationHints hints;
  hints.baseline_mm = 10;
  hints.image_size = "640x480";
  const auto found = parseCalibration(openCvYaml(""), "c", hints);
  EXPECT_NEAR(found.baseline_mm(), 10, 1e-12);
  EXPECT_NEAR(found.right_from_left.translation().y(), 0.04, 1e-5);  // the direction stays
  expectSize(found, 640, 480);
  for (const char* size : {"640", "640x", "0x480", "-640x480", "640x480.5", "1e9x480", "wide"}) {
    hints.image_size = size;
    expectError<OptionError>([&] { parseCalibration(openCvYaml(""), "c", hints); },
                             {"calibration.image_size", size, "640x480"});
  }
  hints.image_size = "640x480";
  hints.unit = "furlong";
  expectError<OptionError>([&] { parseCalibration(openCvYaml(), "c", hints); },
                           {"calibration.unit"});
}

TEST(CalibrationReader, WritesWhatItReadsBitByBit) {
  const auto first = parseCalibration(openCas(), "c");
  const auto again = parseCalibration(calibrationYaml(first), "c");
  EXPECT_EQ(first.left.distortion.coefficients, again.left.distortion.coefficients);
  EXPECT_EQ(first.right.distortion.coefficients, again.right.distortion.coefficients);
  EXPECT_EQ(first.left.pinhole.matrix(), again.left.pinhole.matrix());
  EXPECT_EQ(first.right.pinhole.matrix(), again.right.pinhole.matrix());
  EXPECT_EQ(first.right_from_left.matrix(), again.right_from_left.matrix());
  expectSize(again, 640, 480);
}

TEST(CalibrationReader, WritesWhatOpenCvReads) {
  TemporaryFolder folder;
  writeCalibration(folder / "c.yaml", parseCalibration(openCas(), "c"));
  cv::FileStorage storage((folder / "c.yaml").string(), cv::FileStorage::READ);
  cv::Mat k, d, t;
  storage["M2"] >> k;
  storage["D2"] >> d;
  storage["T"] >> t;
  EXPECT_EQ(static_cast<int>(storage["rectified"]), 0);
  EXPECT_EQ(static_cast<std::string>(storage["unit"]), "mm");
  EXPECT_DOUBLE_EQ(k.at<double>(1, 1), 505);
  EXPECT_EQ(d.total(), 8U);
  EXPECT_DOUBLE_EQ(d.at<double>(7), 0.9);
  EXPECT_DOUBLE_EQ(t.at<double>(0), -5);
  expectError<OptionError>(
      [&] { writeCalibration(folder / "c.yaml", parseCalibration(openCas(), "c")); },
      {"c.yaml", "`overwrite=`"});
}

TEST(CalibrationReader, AFolderWithoutCalibrationSaysWhatToAdd) {
  TemporaryFolder folder;
  expectError<InputError>([&] { readCalibration(folder.path()); }, {"calibration.yaml"});
  expectError<InputError>([&] { readCalibration(folder / "none.yaml"); }, {"none.yaml", "no such"});
}

TEST(CalibrationReader, APartWithoutItsPartnerSaysSo) {
  TemporaryFolder folder;
  put(folder / "left.yaml",
      rosYaml("500 0 321 0 500 241 0 0 1", "0 0 0 0 0", "1 0 0 0 1 0 0 0 1", "0"));
  expectError<InputError>([&] { readCalibration(folder.path()); }, {"left.yaml", "other camera"});
}

}  // namespace
}  // namespace softscope::test
