#include "io/calibrations/shipped_calibrations.h"

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

using TextJson = nlohmann::ordered_json;

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + exactText(value);
  return text;
}

std::vector<double> rowsInOrder(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

std::vector<double> projectionOf(const RawCamera& camera, double shift) {
  const PinholeCamera& p = camera.pinhole;
  return {p.fx_px, 0, p.cx_px, p.fx_px * shift, 0, p.fy_px, p.cy_px, 0, 0, 0, 1, 0};
}

std::vector<double> fiveOf(const RawCamera& camera) {
  const auto& c = camera.distortion.coefficients;
  for (std::size_t i = 5; i < c.size(); ++i)
    require(c[i] == 0, "the lens", c[i], "this form has five coefficients; leave the others at 0");
  return {c.begin(), c.begin() + 5};
}

TextJson rowsJson(const Eigen::Matrix3d& m) {
  TextJson rows = TextJson::array();
  for (int r = 0; r < 3; ++r) rows.push_back({m(r, 0), m(r, 1), m(r, 2)});
  return rows;
}

std::string iniSection(const char* name, const RawCamera& camera) {
  const PinholeCamera& p = camera.pinhole;
  std::string text = say("[", name, "]\nfc_x=", exactText(p.fx_px), "\nfc_y=", exactText(p.fy_px),
                         "\ncc_x=", exactText(p.cx_px), "\ncc_y=", exactText(p.cy_px),
                         "\nres_x=", p.width_px, "\nres_y=", p.height_px, "\n");
  const std::vector<double> lens = fiveOf(camera);
  for (std::size_t i = 0; i < lens.size(); ++i)
    text += say("kc_", i, "=", exactText(lens[i]), "\n");
  return text;
}

}  // namespace

std::string projectionJson(const StereoCalibration& calibration) {
  const double shift_mm = calibration.right_from_left.translation().x();
  const auto entry = [](const std::vector<double>& p) {
    return TextJson{{"rows", 3}, {"cols", 4}, {"data", p}};
  };
  return TextJson{{"P1", entry(projectionOf(calibration.left, 0))},
                  {"P2", entry(projectionOf(calibration.right, shift_mm))}}
             .dump(1) +
         "\n";
}

std::string calibrationIni(const StereoCalibration& calibration) {
  std::string text =
      iniSection("StereoLeft", calibration.left) + iniSection("StereoRight", calibration.right);
  const std::vector<double> rotation = rowsInOrder(calibration.right_from_left.linear());
  for (std::size_t i = 0; i < rotation.size(); ++i)
    text += say("R_", i, "=", exactText(rotation[i]), "\n");
  for (int i = 0; i < 3; ++i)
    text += say("T_", i, "=", exactText(calibration.right_from_left.translation()[i]), "\n");
  return text;
}

std::string cameraInfoYaml(const StereoCalibration& calibration, bool right) {
  const RawCamera& camera = right ? calibration.right : calibration.left;
  const double shift_m = right ? calibration.right_from_left.translation().x() / 1000 : 0;
  return say("height: ", camera.pinhole.height_px, "\nwidth: ", camera.pinhole.width_px,
             "\ndistortion_model: plumb_bob\nD: [0.0, 0.0, 0.0, 0.0, 0.0]\nK: [",
             joined(rowsInOrder(camera.pinhole.matrix())),
             "]\nR: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\nP: [",
             joined(projectionOf(camera, shift_m)), "]\n");
}

std::string firstStirCalibrationJson(const StereoCalibration& calibration) {
  const Eigen::Vector3d t_m = calibration.right_from_left.translation() / 1000;
  return TextJson{{"leftcameramat", rowsJson(calibration.left.pinhole.matrix())},
                  {"rightcameramat", rowsJson(calibration.right.pinhole.matrix())},
                  {"leftdistortioncoeffs", fiveOf(calibration.left)},
                  {"rightdistortioncoeffs", fiveOf(calibration.right)},
                  {"rotation", rowsJson(calibration.right_from_left.linear())},
                  {"translation", {t_m.x(), t_m.y(), t_m.z()}}}
             .dump(1) +
         "\n";
}

}  // namespace softscope
