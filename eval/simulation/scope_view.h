// eval/simulation/scope_view.h: what one camera of the scope sees of the tissue, by ray casting.
#pragma once

#include <vector>

#include "core/camera.h"
#include "core/raster.h"
#include "core/triangle_mesh.h"
#include "eval/simulation/ray_tree.h"
#include "eval/simulation/scope_shading.h"
#include "eval/simulation/tissue_skin.h"

namespace softscope {

/// The tissue at one moment, in the left camera's frame, ready for rays.
struct ScopeScene {
  ScopeScene(std::vector<Eigen::Vector3f> vertices_left_mm, const std::vector<Triangle>& all);

  std::vector<Eigen::Vector3f> vertices_mm;
  const std::vector<Triangle>& triangles;  // must outlive the scene
  std::vector<Eigen::Vector3f> normals;
  RayTree tree;
};

/// Linear light, red green blue, of a camera whose axes are the left one's and whose centre lies at
/// `eye_mm` in the left frame. Mean of 2 x 2 rays a pixel; black where no tissue is.
/// Paints what is new to `skin`.
Raster<Eigen::Vector3f> renderView(const ScopeScene& scene, TissueSkin& skin,
                                   const ScopeLight& light, double relief,
                                   const PinholeCamera& camera, const Eigen::Vector3f& eye_mm);

/// What the ray through the centre of each pixel of the left camera meets.
Raster<RayHit> castCentres(const ScopeScene& scene, const PinholeCamera& left);

/// Depth in mm of such hits, computed in double; NaN where nothing was met.
Raster<float> depthOf(const Raster<RayHit>& hits, const ScopeScene& scene,
                      const PinholeCamera& left);

}  // namespace softscope
