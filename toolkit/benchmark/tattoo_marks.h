// toolkit/benchmark/tattoo_marks.h: tattoos of STIR in one view, and in 3-D from both.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image.h"
#include "core/stereo_rig.h"

namespace softscope {

/// Connected (8 neighbours) non-zero part of a segmentation, and its bounding box.
struct TattooMark {
  int u_px = 0, v_px = 0;  // upper left pixel of the box
  int width_px = 0, height_px = 0;

  Eigen::Vector2d centre() const {
    return {u_px + (width_px - 1) / 2.0, v_px + (height_px - 1) / 2.0};
  }
};

/// In the order of their first pixels, row by row.
std::vector<TattooMark> tattooMarks(const Mask& segmentation);

struct TattooView {
  Mask segmentation;
  GrayImage infrared;
};

/// One per left mark, mm, in the frame of the left camera; NaN without a partner. As in STIRLoader,
/// views are taken as parallel and free of distortion, and the disparity is u_left + (cx_right -
/// cx_left) - u_right. Candidates are right marks at most 10 px higher or lower in images of 1024
/// rows, at a depth of 40 to 600 mm (STIRLoader: 8 to 105 px of its images). Of several, the one
/// with the most similar infrared image (zero-mean normalised cross-correlation over the box of the
/// left mark); a right mark belongs to the most similar left one. Throws InputError for images of
/// different sizes.
std::vector<Eigen::Vector3d> tattooPositions(const TattooView& left, const TattooView& right,
                                             const StereoCalibration& calibration);

}  // namespace softscope
