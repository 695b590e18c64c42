// eval/simulation/view/scope_view.h: image of one camera of the scope, rendered by ray casting of
// the tissue.
#pragma once

#include <vector>

#include "core/raster.h"
#include "core/triangle_mesh.h"
#include "eval/simulation/camera/scope_lens.h"
#include "eval/simulation/surface/ray_tree.h"
#include "eval/simulation/texture/tissue_skin.h"
#include "eval/simulation/tissue/tissue_body.h"
#include "eval/simulation/view/scope_shading.h"
#include "eval/simulation/view/scope_tool.h"

namespace softscope {

/// The tissue at one moment, in the left camera's frame, ready for rays.
struct ScopeScene {
  /// `open`: of the wound, 0 to 1.
  ScopeScene(std::vector<Eigen::Vector3f> vertices_left_mm, const TissueBody& body, float open);

  std::vector<Eigen::Vector3f> vertices_mm;
  const std::vector<Triangle>& triangles;  // the body's, which must outlive the scene
  std::vector<Eigen::Vector3f> normals;
  RayTree tree;
};

/// One camera of the scope, in the left one's frame.
struct ScopeEye {
  ScopeLens lens;
  Eigen::Vector3f centre_mm = Eigen::Vector3f::Zero();
  Eigen::Matrix3f left_from_eye = Eigen::Matrix3f::Identity();

  /// Through a pixel, in the left camera's frame.
  Eigen::Vector3f ray(double u_px, double v_px) const {
    return left_from_eye * lens.ray(u_px, v_px).cast<float>();
  }
};

/// What is before the eye besides tissue, and what lights both.
struct ScopeSurroundings {
  const ScopeLight& light;
  double relief = 1;
  const ScopeTool& instrument;
};

/// Linear light, red green blue. Mean of 2 x 2 rays a pixel; black where nothing is.
/// Paints what is new to `skin`.
Raster<Eigen::Vector3f> renderView(const ScopeScene& scene, TissueSkin& skin,
                                   const ScopeSurroundings& around, const ScopeEye& eye);

/// What the ray through the centre of each pixel of the left camera meets.
Raster<RayHit> castCentres(const ScopeScene& scene, const ScopeLens& left);

/// Of the tissue at such hits, interpolated between its vertices; 0 where nothing was met.
Raster<Eigen::Vector3f> normalsOf(const Raster<RayHit>& hits, const ScopeScene& scene);

/// Non-zero where the instrument hides what such a ray would meet.
Mask instrumentMask(const Raster<RayHit>& hits, const ScopeTool& instrument, const ScopeLens& left);

/// Depth in mm of such hits, computed in double; NaN where nothing was met.
Raster<float> depthOf(const Raster<RayHit>& hits, const ScopeScene& scene, const ScopeLens& left);

}  // namespace softscope
