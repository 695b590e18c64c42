#include "toolkit/benchmark/tattoo_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/not_measured.h"

namespace softscope {
namespace {

constexpr double kMostRows = 10.0 / 1024;  // of the height of the image (STIRLoader)
constexpr double kLeastDepthMm = 40, kMostDepthMm = 600;

/// Removes the part around its first pixel from `rest`.
TattooMark takeMark(int u, int v, Mask* rest) {
  int u_min = u, u_max = u, v_max = v;
  std::vector<Eigen::Vector2i> front{{u, v}};
  rest->at(u, v) = 0;
  while (!front.empty()) {
    const Eigen::Vector2i at = front.back();
    front.pop_back();
    u_min = std::min(u_min, at.x());
    u_max = std::max(u_max, at.x());
    v_max = std::max(v_max, at.y());
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du) {
        const Eigen::Vector2i next(at.x() + du, at.y() + dv);
        if (!rest->contains(next.x(), next.y()) || rest->at(next.x(), next.y()) == 0) continue;
        rest->at(next.x(), next.y()) = 0;
        front.push_back(next);
      }
  }
  return {u_min, v, u_max - u_min + 1, v_max - v + 1};
}

/// Of the box of the left mark with the same rows of the right image, its centre at that of the
/// right mark; -1 outside of the image or without contrast.
double similarity(const GrayImage& left, const TattooMark& mark, const GrayImage& right,
                  const TattooMark& other) {
  const int shift_px = other.u_px + other.width_px / 2 - mark.width_px / 2 - mark.u_px;
  if (mark.u_px + shift_px < 0 || mark.u_px + shift_px + mark.width_px > right.width_px) return -1;
  double count = 0, sum_l = 0, sum_r = 0, square_l = 0, square_r = 0, product = 0;
  for (int v = mark.v_px; v < mark.v_px + mark.height_px; ++v)
    for (int u = mark.u_px; u < mark.u_px + mark.width_px; ++u) {
      const double l = left.at(u, v), r = right.at(u + shift_px, v);
      ++count;
      sum_l += l;
      sum_r += r;
      square_l += l * l;
      square_r += r * r;
      product += l * r;
    }
  const double spread = (square_l - sum_l * sum_l / count) * (square_r - sum_r * sum_r / count);
  return spread > 0 ? (product - sum_l * sum_r / count) / std::sqrt(spread) : -1;
}

struct Partner {
  std::size_t mark = 0;
  double similarity = -std::numeric_limits<double>::infinity();
  double depth_mm = kNotMeasured<double>;
};

}  // namespace

std::vector<TattooMark> tattooMarks(const Mask& segmentation) {
  Mask rest = segmentation;
  std::vector<TattooMark> marks;
  for (int v = 0; v < rest.height_px; ++v)
    for (int u = 0; u < rest.width_px; ++u)
      if (rest.at(u, v) != 0) marks.push_back(takeMark(u, v, &rest));
  return marks;
}

std::vector<Eigen::Vector3d> tattooPositions(const TattooView& left, const TattooView& right,
                                             const StereoCalibration& calibration) {
  for (const GrayImage* image : {&left.infrared, &right.segmentation, &right.infrared})
    if (!image->sameShape(left.segmentation))
      throw InputError("the segmentations and infrared images of both views differ in size");
  const std::vector<TattooMark> marks = tattooMarks(left.segmentation),
                                others = tattooMarks(right.segmentation);
  const PinholeCamera& camera = calibration.left.pinhole;
  const double shift_px = calibration.right.pinhole.cx_px - camera.cx_px;
  const double rows_px = std::max(1.0, kMostRows * left.segmentation.height_px);
  std::vector<Partner> partners(marks.size());
  std::vector<double> best(others.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < marks.size(); ++i)
    for (std::size_t k = 0; k < others.size(); ++k) {
      const Eigen::Vector2d offset = marks[i].centre() - others[k].centre();
      const double depth_mm = camera.fx_px * calibration.baseline_mm() / (offset.x() + shift_px);
      if (std::abs(offset.y()) > rows_px ||
          !(depth_mm >= kLeastDepthMm && depth_mm <= kMostDepthMm))
        continue;
      const double value = similarity(left.infrared, marks[i], right.infrared, others[k]);
      best[k] = std::max(best[k], value);
      if (value > partners[i].similarity) partners[i] = {k, value, depth_mm};
    }
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Partner& partner = partners[i];
    const bool is_own = std::isfinite(partner.depth_mm) && partner.similarity >= best[partner.mark];
    const Eigen::Vector2d at = marks[i].centre();
    positions.push_back(is_own ? liftPixel(camera, at.x(), at.y(), partner.depth_mm)
                               : Eigen::Vector3d::Constant(kNotMeasured<double>));
  }
  return positions;
}

}  // namespace softscope
