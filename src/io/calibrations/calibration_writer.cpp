#include "io/calibrations/calibration_writer.h"

#include <vector>

#include "io/files/atomic_file.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

std::string matrixYaml(const char* name, int rows, const std::vector<double>& values) {
  std::string data;
  for (const double value : values) data += (data.empty() ? "" : ", ") + exactText(value);
  return say(name, ": !!opencv-matrix\n   rows: ", rows, "\n   cols: ", values.size() / rows,
             "\n   dt: d\n   data: [ ", data, " ]\n");
}

std::vector<double> rowMajor(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

/// Smallest number of coefficients of OpenCV's model without loss: 5, 8 or 12.
std::vector<double> shortest(const LensDistortion& distortion) {
  const auto& k = distortion.coefficients;
  std::size_t used = k.size();
  while (used > 0 && k[used - 1] == 0) --used;
  const std::size_t count = used <= 5 ? 5 : used <= 8 ? 8 : 12;
  return {k.begin(), k.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

std::string calibrationYaml(const StereoCalibration& calibration) {
  const Eigen::Vector3d t = calibration.right_from_left.translation();
  return say("%YAML:1.0\n---\nimage_width: ", calibration.left.pinhole.width_px,
             "\nimage_height: ", calibration.left.pinhole.height_px,
             "\nunit: mm\nrectified: ", calibration.rectified ? 1 : 0,
             "\ndepth_unit_mm: ", exactText(calibration.depth_unit_mm), "\n",
             matrixYaml("M1", 3, rowMajor(calibration.left.pinhole.matrix())),
             matrixYaml("D1", 1, shortest(calibration.left.distortion)),
             matrixYaml("M2", 3, rowMajor(calibration.right.pinhole.matrix())),
             matrixYaml("D2", 1, shortest(calibration.right.distortion)),
             matrixYaml("R", 3, rowMajor(calibration.right_from_left.linear())),
             matrixYaml("T", 3, {t.x(), t.y(), t.z()}));
}

void writeCalibration(const std::filesystem::path& file, const StereoCalibration& calibration,
                      bool overwrite) {
  writeFile(file, calibrationYaml(calibration), overwrite);
}

}  // namespace softscope
