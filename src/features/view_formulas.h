// src/features/view_formulas.h: formulas of the model view, for the CPU and the GPU.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/hd.h"
#include "features/kernels.h"

namespace softscope {

constexpr float kSmallestDiscCosine = 0.25f;  // discs seen more obliquely are drawn at this angle
constexpr float kNearestDiscMm = 1.0f;

// --- the disc of a point ---------------------------------------------------------------------

struct ViewVector {
  float x, y, z;
};
/// In the order of Eigen's sum of three.
SOFTSCOPE_HD inline float productOf(const ViewVector& a, const ViewVector& b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}
SOFTSCOPE_HD inline float lengthOf(const ViewVector& a) { return std::sqrt(productOf(a, a)); }

/// Camera pose in floats.
struct ViewProjector {
  ViewVector rows[3];  // of the rotation left_from_world
  ViewVector translation_mm;
  float width, height, fx, fy, cx, cy, radius_mm, min_radius_px;

  SOFTSCOPE_HD ViewVector turned(const ViewVector& v) const {
    return {productOf(rows[0], v), productOf(rows[1], v), productOf(rows[2], v)};
  }
};

/// The plane n . x = n . p has inverse depth n . ray / n . p. False: back-facing.
SOFTSCOPE_HD inline bool tiltDisc(const ViewProjector& camera, const ViewVector& normal,
                                  const ViewVector& p, SplatDisc* disc) {
  disc->slope_u = disc->slope_v = 0;
  const float length = lengthOf(normal);
  if (!(length > 0.5f)) return true;  // no normal: faces the camera
  const float distance = lengthOf(p);
  const float cosine = -productOf(normal, p) / (length * distance);
  if (!(cosine > 0)) return false;
  const float least = cosine < kSmallestDiscCosine ? kSmallestDiscCosine : cosine;
  const float along = -least * length * distance;
  disc->slope_u = normal.x / (camera.fx * along);
  disc->slope_v = normal.y / (camera.fy * along);
  return true;
}

/// Position and plane of the disc of a point; colours and
/// index are set by the caller. False for an invisible point.
SOFTSCOPE_HD inline bool placeDisc(const ViewProjector& camera, const ViewVector& position_mm,
                                   const ViewVector& normal, SplatDisc* disc) {
  ViewVector p = camera.turned(position_mm);
  p.x += camera.translation_mm.x;
  p.y += camera.translation_mm.y;
  p.z += camera.translation_mm.z;
  const float finite = (p.x - p.x) + (p.y - p.y) + (p.z - p.z);  // else NaN
  if (!(p.z > kNearestDiscMm) || !(finite == 0)) return false;
  disc->inverse_depth = 1 / p.z;
  disc->u_px = camera.fx * p.x * disc->inverse_depth + camera.cx;
  disc->v_px = camera.fy * p.y * disc->inverse_depth + camera.cy;
  const float radius = camera.radius_mm * camera.fx * disc->inverse_depth;
  const float largest = static_cast<float>(kLargestDiscPx);
  const float r = disc->radius_px =
      radius < camera.min_radius_px ? camera.min_radius_px : (largest < radius ? largest : radius);
  if (!(disc->u_px > -r && disc->u_px < camera.width - 1 + r && disc->v_px > -r &&
        disc->v_px < camera.height - 1 + r))
    return false;
  return tiltDisc(camera, camera.turned(normal), p, disc);
}

// --- the pixels of a disc --------------------------------------------------------------------

/// Discs are drawn in groups of this many pixels of a row: the distance of a
/// pixel from the centre is that of its group, plus its position in the group.
constexpr int kSplatLanes = 8;

SOFTSCOPE_FORMULA int floorOf(float x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<float>(i) > x ? 1 : 0);
}
SOFTSCOPE_FORMULA int ceilOf(float x) { return -floorOf(-x); }

/// Pixels of a disc: rows [v0, v1], columns from u0 in groups of kSplatLanes.
struct DiscBox {
  int u0, groups, v0, v1;
};
SOFTSCOPE_FORMULA DiscBox discBox(const SplatDisc& disc) {
  const float radius = disc.radius_px;
  DiscBox box;
  box.u0 = ceilOf(disc.u_px - radius);
  box.groups = (floorOf(disc.u_px + radius) - box.u0 + kSplatLanes) / kSplatLanes;
  box.v0 = ceilOf(disc.v_px - radius);
  box.v1 = floorOf(disc.v_px + radius);
  return box;
}

/// Inverse depth of the plane of the disc, x and y pixels from its centre.
template <class Value>
SOFTSCOPE_FORMULA Value discInverseDepth(const SplatDisc& disc, const Value& x, float y) {
  return disc.inverse_depth + disc.slope_v * y + disc.slope_u * x;
}
/// 1 at the centre, 0 at the border.
template <class Value>
SOFTSCOPE_FORMULA Value discFalloff(const Value& x, float y, float inverse_radius_sq) {
  return 1 - (x * x + y * y) * inverse_radius_sq;
}
/// Smallest inverse depth that belongs to the front surface.
template <class Value>
SOFTSCOPE_FORMULA Value frontLimit(const Value& front, float tolerance_mm) {
  return front * (1 - tolerance_mm * front);
}

// --- from sums to looks ----------------------------------------------------------------------

constexpr int kLooks = 4;  // red, green, blue, anchor

/// Mean colours of the discs at a pixel, and the offset of the pixel
/// from the mean of their centres, the position of these colours.
struct BlendedPixel {
  float looks[kLooks], shift_u, shift_v;
};

/// Whether the neighbours on both sides of a pixel are on one surface.
SOFTSCOPE_HD inline bool isOneSurface(float before_mm, float after_mm, float surface_depth_mm) {
  return std::fabs(before_mm - after_mm) < 2 * surface_depth_mm;
}
/// Colours shifted along the slope between both neighbours.
SOFTSCOPE_HD inline float movedLooks(float looks, float shift_px, float before, float after) {
  return looks + shift_px * (0.5f * (after - before));
}
SOFTSCOPE_HD inline std::uint8_t looksByte(float value) {
  const float clamped = value < 0.0f ? 0.0f : (255.0f < value ? 255.0f : value);
  return static_cast<std::uint8_t>(clamped + 0.5f);
}

// --- gaps ------------------------------------------------------------------------------------

/// Whether a surface ends here: the next pixel is empty or far behind.
SOFTSCOPE_HD inline bool endsSurface(float here_mm, float next_mm, float step_mm) {
  return here_mm > 0 && !(next_mm <= here_mm + step_mm);
}
SOFTSCOPE_HD inline bool continuesSurface(float here_mm, float there_mm, float step_mm) {
  return std::fabs(there_mm - here_mm) <= step_mm;
}
/// Relative position of pixel `at` between both ends of a gap.
SOFTSCOPE_HD inline float shareOfGap(int begin, int at, int end) {
  return static_cast<float>(at - begin) / static_cast<float>(end - begin);
}
SOFTSCOPE_HD inline float depthInGap(float begin_mm, float end_mm, float share) {
  return 1 / ((1 - share) * (1 / begin_mm) + share * (1 / end_mm));
}
SOFTSCOPE_HD inline std::uint8_t mixBytes(std::uint8_t a, std::uint8_t b, float share_of_b) {
  return static_cast<std::uint8_t>(std::lround((1 - share_of_b) * a + share_of_b * b));
}

}  // namespace softscope
