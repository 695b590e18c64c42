// toolkit/calibration/calibration_template.cpp: text of each template.
#include "toolkit/calibration/calibration_template.h"

#include "core/error.h"
#include "core/nearest_name.h"

namespace softscope {
namespace {

constexpr const char* kStereo = R"(%YAML:1.0
---
# A stereo calibration for raw images, in the names of OpenCV's stereoCalibrate.
# Replace every number. `softscope calibrate` measures them from films of a board.
image_width: 640            # px, of one view; the size of your images
image_height: 480
unit: mm                    # of T: mm, cm or m
rectified: 0                # 1: the images are rectified already
# Left and right camera: [fx, 0, cx, 0, fy, cy, 0, 0, 1], px; (0, 0) is the centre of the first pixel.
M1: [ 520.0, 0.0, 319.5, 0.0, 520.0, 239.5, 0.0, 0.0, 1.0 ]
M2: [ 520.0, 0.0, 319.5, 0.0, 520.0, 239.5, 0.0, 0.0, 1.0 ]
# Lens distortion k1, k2, p1, p2, k3 (4, 5, 8, 12 or 14 numbers in OpenCV's order).
D1: [ 0.0, 0.0, 0.0, 0.0, 0.0 ]
D2: [ 0.0, 0.0, 0.0, 0.0, 0.0 ]
# p_right = R * p_left + T: a right camera 5 mm to the right of the left one has T = [-5, 0, 0].
R: [ 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 ]
T: [ -5.0, 0.0, 0.0 ]
)";

constexpr const char* kRectified = R"(%YAML:1.0
---
# A rectified stereo pair: rows correspond, lenses have no distortion. Replace every number.
f: 520.0                    # focal length, px
cx: 319.5                   # principal point, px; (0, 0) is the centre of the first pixel
cy: 239.5
baseline: 5.0               # between the cameras, in `unit`
unit: mm                    # mm, cm or m
# Optional: the size of the images (else theirs), and cx of the right view where it is another one.
# image_width: 640
# image_height: 480
# cx_right: 319.5
)";

constexpr const char* kRgbD = R"(%YAML:1.0
---
# One camera, for depth files with colour images or depth files alone. Images and depth must be
# undistorted and of one size. Replace every number.
fx: 520.0                   # focal length, px
fy: 520.0
cx: 319.5                   # principal point, px; (0, 0) is the centre of the first pixel
cy: 239.5
depth_unit_mm: 0.01         # mm that one step of a 16-bit depth file is worth; 1 for millimetres
# Optional: the size of the images (else theirs).
# image_width: 640
# image_height: 480
)";

}  // namespace

const std::vector<std::string>& calibrationTemplateNames() {
  static const std::vector<std::string> names{"stereo", "rectified", "rgb-d"};
  return names;
}

std::string calibrationTemplate(const std::string& kind) {
  if (kind == "stereo") return kStereo;
  if (kind == "rectified") return kRectified;
  if (kind == "rgb-d") return kRgbD;
  const std::string nearest = nearestName(kind, calibrationTemplateNames());
  throw OptionError("KIND is `" + kind + "`, but must be stereo, rectified or rgb-d" +
                    (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)"));
}

}  // namespace softscope
