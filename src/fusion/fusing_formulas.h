// src/fusion/fusing_formulas.h: averaging of one model point with its measurement, for the CPU and
// the GPU.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/hd.h"
#include "core/warp_graph.h"
#include "fusion/colour_gain.h"
#include "fusion/colour_levels.h"
#include "fusion/frame_rasters.h"
#include "fusion/fusion_options.h"
#include "fusion/fusion_weights.h"
#include "fusion/innovation.h"
#include "fusion/model_point.h"
#include "fusion/posed_camera.h"
#include "fusion/sight.h"

namespace softscope {

/// Options of averaging in single precision, for the inner loops.
struct FusingLimits {
  float truncation_mm = 0, buried_mm = 0;
  float reference_sigma_mm = 0, max_measurement_weight = 0, max_weight = 0;
  float half_spacing_mm = 0;  // of the nodes
  float warp_noise = 0;       // variance of one warp there, in units of the reference variance
  NodeTrust node_trust = NodeTrust::kEqual;
  bool soft_truncation = false;
  ColourOptions colour;
};

inline FusingLimits fusingLimits(const PointFusionOptions& options, const ColourOptions& colour) {
  const double reference_mm = options.reference_sigma_mm > 0 ? options.reference_sigma_mm : 0.1;
  const double ratio = options.warp_sigma_mm / reference_mm;
  FusingLimits limits;
  limits.truncation_mm = static_cast<float>(options.truncation_mm);
  limits.buried_mm = static_cast<float>(options.buried_mm);
  limits.reference_sigma_mm = static_cast<float>(options.reference_sigma_mm);
  limits.max_measurement_weight = static_cast<float>(options.max_measurement_weight);
  limits.max_weight = static_cast<float>(options.max_weight);
  limits.half_spacing_mm = 0.5f * static_cast<float>(options.node_spacing_mm);
  limits.warp_noise = static_cast<float>(ratio * ratio);
  limits.node_trust = options.node_trust;
  limits.soft_truncation = options.soft_truncation;
  limits.colour = colour;
  return limits;
}

/// Frame data for the averaging of points; non-owning.
struct FusingFrame {
  FrameRasters rasters;
  PosedCamera camera;
  ColourGain gain;  // of the image against the model
  FusingLimits limits;
};

inline FusingFrame fusingFrame(const Observation& observation, const ColourGain& gain,
                               const PointFusionOptions& options, const ColourOptions& colour) {
  return {frameRasters(observation), posedCamera(observation.left, observation.world_from_left),
          gain, fusingLimits(options, colour)};
}

/// Properties of the tissue around one point.
struct FusingSurroundings {
  Innovation innovation;
  float node_mm = -1;     // to the nearest node of the point; negative if none
  bool anchored = false;  // the image agrees with the anchors there: docs/fusion.md (F24)
};

SOFTSCOPE_HD inline bool isConfirmedWeight(float weight) {
  return weight >= static_cast<float>(PointFusionOptions::kConfirmedWeight);
}

/// Whether a measurement contradicts a point of this weight: docs/fusion.md (F10).
SOFTSCOPE_HD inline bool isContradicted(const PointSight& point, float weight,
                                        const FusingLimits& limits) {
  if (point.sight == Sight::kSeenThrough) return true;
  if (point.sight == Sight::kHidden && point.ahead_mm < -limits.truncation_mm &&
      point.ahead_mm > -limits.buried_mm)
    return true;
  if (isConfirmedWeight(weight)) return false;
  return point.sight == Sight::kHidden || point.sight == Sight::kTurned;
}

/// (F5), 1 for depths without sigma.
SOFTSCOPE_HD inline float depthWeightAt(std::int32_t pixel, const float* sigma_mm,
                                        float reference_sigma_mm, float max_measurement_weight) {
  return sigma_mm == nullptr
             ? 1
             : depthWeight(sigma_mm[pixel], reference_sigma_mm, max_measurement_weight);
}
SOFTSCOPE_HD inline float depthWeightAt(std::int32_t pixel, const FusingFrame& frame) {
  return depthWeightAt(pixel, frame.rasters.sigma_mm, frame.limits.reference_sigma_mm,
                       frame.limits.max_measurement_weight);
}

/// Weight of a point after a contradiction by the measurement at `pixel`: (F10), (F22).
SOFTSCOPE_HD inline float weightAfterContradiction(float weight, float excess_mm2,
                                                   std::int32_t pixel, const FusingFrame& frame) {
  const float measured = depthWeightAt(pixel, frame);
  return contradictedWeight(
      weightAfterInnovation(weight, excess_mm2, frame.limits.reference_sigma_mm),
      measured < 1 ? measured : 1.0f, static_cast<float>(PointFusionOptions::kContradictionLoss));
}

/// From a point to the nearest node of its stencil, mm.
SOFTSCOPE_HD inline float nearestNodeMm(const NodeStencil& stencil, const Eigen::Vector3d* nodes_mm,
                                        const Eigen::Vector3f& point_mm) {
  double nearest_mm2 = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kNodesPerPoint; ++k) {
    const double away_mm2 = (nodes_mm[stencil[k]] - point_mm.cast<double>()).squaredNorm();
    nearest_mm2 = away_mm2 < nearest_mm2 ? away_mm2 : nearest_mm2;
  }
  return static_cast<float>(std::sqrt(nearest_mm2));
}

/// Weight of the measurement: (F5) to (F7).
SOFTSCOPE_HD inline float measurementWeight(const PointSight& point, float truncation_mm,
                                            float node_mm, const FusingFrame& frame) {
  const FusingLimits& limits = frame.limits;
  const float weight = depthWeightAt(point.pixel, frame) *
                       truncationWeight(point.ahead_mm, truncation_mm, limits.soft_truncation);
  return node_mm < 0 ? weight
                     : weight * nodeWeight(limits.node_trust, node_mm / limits.half_spacing_mm);
}

/// Weight of the point before the measurement: (F7), (F22).
SOFTSCOPE_HD inline float priorWeight(float weight, float node_mm, float excess_mm2,
                                      const FusingLimits& limits) {
  if (node_mm >= 0 && limits.node_trust == NodeTrust::kWarpNoise)
    weight = weightAfterWarp(weight, node_mm / limits.half_spacing_mm, limits.warp_noise);
  return weightAfterInnovation(weight, excess_mm2, limits.reference_sigma_mm);
}

/// Weighted step towards the measured surface, along the ray of the point: (F8). `left`
/// is the point, `measured_left` the measured normal, both in the left camera frame.
SOFTSCOPE_HD inline void averageShape(const Eigen::Vector3f& left, float ahead_mm,
                                      const Eigen::Vector3f& measured_left, float gain,
                                      const PosedCamera& camera, ModelPoint* point) {
  const Eigen::Vector3f step = left * (gain * ahead_mm / left.norm());
  point->position_mm += camera.left_from_world.transpose() * step;
  const Eigen::Vector3f measured = camera.left_from_world.transpose() * measured_left;
  point->normal = ((1 - gain) * point->normal + gain * measured).normalized();
}

/// Coordinate clamped to 0 … count - 1.
SOFTSCOPE_HD inline float withinImage(float at, int count) {
  const float last = static_cast<float>(count - 1);
  return at < 0 ? 0.0f : (last < at ? last : at);
}

/// Bilinear; `right` and `low` are the shares of the second column and the second row.
SOFTSCOPE_HD inline std::uint8_t levelBetween(std::uint8_t top_left, std::uint8_t top_right,
                                              std::uint8_t low_left, std::uint8_t low_right,
                                              float right, float low) {
  const float top = (1 - right) * top_left + right * top_right;
  const float bottom = (1 - right) * low_left + right * low_right;
  return toByte((1 - low) * top + low * bottom);
}

/// Image interpolated at a point, clamped at the border.
SOFTSCOPE_HD inline Rgb8 colourAt(const Eigen::Vector3f& left, const Rgb8* image,
                                  const PosedCamera& camera) {
  const int width = camera.width_px, height = camera.height_px;
  const float column = withinImage(camera.fx_px * left.x() / left.z() + camera.cx_px, width);
  const float row = withinImage(camera.fy_px * left.y() / left.z() + camera.cy_px, height);
  const int u = static_cast<int>(column), v = static_cast<int>(row);
  const float right = column - static_cast<float>(u), low = row - static_cast<float>(v);
  const Rgb8* above = image + static_cast<std::ptrdiff_t>(v) * width;
  const Rgb8* below = v + 1 < height ? above + width : above;
  const int next = u + 1 < width ? u + 1 : u;
  const Rgb8 a = above[u], b = above[next], c = below[u], d = below[next];
  return {levelBetween(a.red, b.red, c.red, d.red, right, low),
          levelBetween(a.green, b.green, c.green, d.green, right, low),
          levelBetween(a.blue, b.blue, c.blue, d.blue, right, low)};
}

SOFTSCOPE_HD inline std::uint8_t averagedLevel(std::uint8_t known, std::uint8_t fresh, float gain) {
  return toByte(static_cast<float>(known) +
                gain * (static_cast<float>(fresh) - static_cast<float>(known)));
}

/// Whether `fresh` exceeds the brightness of the point by the limit in every channel: (F13).
SOFTSCOPE_HD inline bool isBrightened(Rgb8 fresh, Rgb8 known, int limit) {
  return fresh.red - known.red >= limit && fresh.green - known.green >= limit &&
         fresh.blue - known.blue >= limit;
}

/// Colour (F13) and anchor (F24). `fresh` is the image at the point,
/// without gain; the point has its weight before the measurement.
SOFTSCOPE_HD inline void averageColour(Rgb8 fresh, float measured, bool anchored,
                                       const ColourOptions& options, ModelPoint* point) {
  Rgb8& known = point->colour;
  if (isBrightened(fresh, known, options.brightening_limit) && isConfirmedWeight(point->weight))
    return;
  const float most = static_cast<float>(options.max_weight);
  const float gain = averagingGain(most < point->weight ? most : point->weight, measured);
  known = {averagedLevel(known.red, fresh.red, gain), averagedLevel(known.green, fresh.green, gain),
           averagedLevel(known.blue, fresh.blue, gain)};
  if (anchored) return;
  const float anchor_gain =
      options.hold_anchors
          ? averagingGain(static_cast<float>(ColourOptions::kAnchorWeight), measured)
          : gain;
  point->anchor = averagedLevel(point->anchor, toGray(fresh), anchor_gain);
}

/// Averages a visible point with the measurement at its pixel: (F8), (F9), (F13), (F21) to (F24).
/// False where the measurement has no weight.
SOFTSCOPE_HD inline bool fusePoint(const PointSight& sight, const FusingSurroundings& around,
                                   const FusingFrame& frame, ModelPoint* point) {
  const FusingLimits& limits = frame.limits;
  const FrameRasters& rasters = frame.rasters;
  const float truncation_mm =
      widenedTruncation(limits.truncation_mm, around.innovation.difference_mm2);
  if (!(std::abs(sight.ahead_mm) < truncation_mm)) return false;
  const float measured = measurementWeight(sight, truncation_mm, around.node_mm, frame);
  point->weight = priorWeight(point->weight, around.node_mm, around.innovation.excess_mm2, limits);
  const float gain = averagingGain(point->weight, measured);
  if (!(gain > 0)) return false;
  const Eigen::Vector3f left = frame.camera.toLeft(point->position_mm);
  if (rasters.colour != nullptr && !isHighlight(rasters.colour[sight.pixel], limits.colour)) {
    const Rgb8 fresh = modelColour(colourAt(left, rasters.colour, frame.camera), frame.gain);
    averageColour(fresh, measured, around.anchored, limits.colour, point);
  }
  averageShape(left, sight.ahead_mm, rasters.normals[sight.pixel], gain, frame.camera, point);
  point->weight = grownWeight(point->weight, measured, limits.max_weight);
  return true;
}

}  // namespace softscope
