// tests/cuda/stereo_cases.h: frames on which the GPU's stereo must give the CPU's bytes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "stereo/depth/depth_from_disparity.h"
#include "stereo/images/view_masks.h"
#include "stereo/matching/elas_matcher.h"
#include "stereo/rectification/row_alignment.h"
#include "support/scene.h"

namespace softscope::test {

/// How many values differ; NaN equals NaN, and -0 differs from 0.
template <class T>
int differing(const Raster<T>& a, const Raster<T>& b) {
  if (!a.sameShape(b)) return -1;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool both_nan = a.values[i] != a.values[i] && b.values[i] != b.values[i];
    count += !both_nan && std::memcmp(&a.values[i], &b.values[i], sizeof(T)) != 0;
  }
  return count;
}

inline int measuredOf(const Raster<float>& raster) {
  return static_cast<int>(std::count_if(raster.values.begin(), raster.values.end(),
                                        [](float x) { return !std::isnan(x); }));
}

/// Normals of any type with the members x, y and z.
template <class Normal>
int differingNormals(const Raster<Normal>& found, const NormalMap& expected) {
  Raster<float> a(expected.width_px, expected.height_px), b = a;
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Normal& n = found.values[i];
      a.values[i] = axis == 0 ? n.x : (axis == 1 ? n.y : n.z);
      b.values[i] = expected.values[i][axis];
    }
    count += differing(a, b);
  }
  return count;
}

/// Tissue with a step, a hole of darkness and a flat part: every rule has something to do.
inline Scene steppedScene(int width, int height) {
  RectifiedRig rig = endoscope();
  const double scale = static_cast<double>(width) / rig.left.width_px;
  rig.left.width_px = width;
  rig.left.height_px = height;
  rig.left.fx_px *= scale;
  rig.left.fy_px *= scale;
  rig.left.cx_px = (width - 1) / 2.0 + 0.37;
  rig.left.cy_px = (height - 1) / 2.0 - 0.21;
  Scene scene = makeScene(rig, nearest(plane(60, 0.3, 0.1), sphere({3, 2, 48}, 7)), 2.0);
  for (int v = height / 5; v < height / 4; ++v)
    for (int u = width / 2; u < width * 3 / 4; ++u) scene.left.at(u, v) = 4;
  for (int v = height * 3 / 5; v < height * 4 / 5; ++v)
    for (int u = width / 8; u < width / 3; ++u)
      scene.left.at(u, v) = static_cast<std::uint8_t>(120 + (u + v) % 2);
  return scene;
}

/// A frame and the settings to measure it with.
struct StereoCase {
  const char* name;
  int width, height;
  StereoOptions options;
  double roll_rad;
  bool masked, bordered;
};

inline StereoOptions optionsTo(int disparity_max_px) {
  StereoOptions options;
  options.disparity_max_px = disparity_max_px;
  return options;
}

inline std::vector<StereoCase> stereoCases() {
  StereoOptions odd = optionsTo(61);
  odd.disparity_min_px = 3;
  odd.elas.support_step_px = 4;
  odd.elas.speckle_size_px = 40;
  odd.smoothing.block_px = 20;
  odd.smoothing.reach_blocks = 1;
  odd.dark_margin_px = 2;
  StereoOptions one_level = optionsTo(40);
  one_level.smoothing.reach_blocks = 0;
  one_level.elas.coarser_levels = 0;
  return {{"defaults", 240, 180, optionsTo(255), 0, false, false},
          {"bordered", 240, 180, optionsTo(255), 0, false, true},
          {"otherOptions", 171, 131, odd, 0.01, true, true},
          {"oneLevel", 96, 80, one_level, 0, false, false}};
}

inline Mask maskOf(const StereoCase& of) {
  if (!of.masked) return {};
  Mask mask(of.width, of.height, 0);
  for (int v = 20; v < 60; ++v)
    for (int u = 30; u < 70; ++u) mask.at(u, v) = 255;
  return mask;
}

/// Corners outside the tissue, another in each view.
inline ViewMasks bordersOf(const StereoCase& of) {
  if (!of.bordered) return {};
  ViewMasks borders{Mask(of.width, of.height, 0), Mask(of.width, of.height, 0)};
  for (int v = 0; v < of.height / 3; ++v)
    for (int u = 0; u < of.width / 3 - v; ++u) {
      borders.left.at(of.width - 1 - u, v) = 255;
      borders.right.at(u, of.height - 1 - v) = 1;
    }
  return borders;
}
inline MatchableViews viewsOf(const Scene& scene, const StereoCase& of) {
  return matchableViews(scene.left, scene.right, bordersOf(of));
}

/// What the CPU gives.
struct CpuDepth {
  CpuDepth(const Scene& scene, const StereoCase& of, const Mask& mask)
      : disparity(ElasMatcher(of.options).match(scene.left, scene.right, bordersOf(of))) {
    removeRoll(of.roll_rad, &disparity.disparity_px);
    depth = depthFromDisparity(disparity, scene.rig);
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (mask.values[i] != 0)
        disparity.disparity_px.values[i] = disparity.sigma_px.values[i] = depth.depth_mm.values[i] =
            depth.sigma_mm.values[i] = std::nanf("");
    normals = normalsFromDepth(depth.depth_mm, scene.rig.left);
  }
  DisparityMap disparity;
  DepthMap depth;
  NormalMap normals;
};

}  // namespace softscope::test
