// eval/simulation/view/scope_view.h: image
// of one camera of the scope by ray casting.
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

/// Tissue at one time, in the left camera frame, prepared for ray casting.
struct ScopeScene {
  /// `open`: opening of the wound, 0 to 1.
  ScopeScene(std::vector<Eigen::Vector3f> vertices_left_mm, const TissueBody& body, float open);

  std::vector<Eigen::Vector3f> vertices_mm;
  const std::vector<Triangle>& triangles;  // of the body, which must outlive the scene
  std::vector<Eigen::Vector3f> normals;
  RayTree tree;
};

/// Camera of the scope, in the frame of the left camera.
struct ScopeEye {
  ScopeLens lens;
  Eigen::Vector3f centre_mm = Eigen::Vector3f::Zero();
  Eigen::Matrix3f left_from_eye = Eigen::Matrix3f::Identity();

  /// Ray through a pixel, in the frame of the left camera.
  Eigen::Vector3f ray(double u_px, double v_px) const {
    return left_from_eye * lens.ray(u_px, v_px).cast<float>();
  }
};

/// Instrument and light of the scene.
struct ScopeSurroundings {
  const ScopeLight& light;
  double relief = 1;
  const ScopeTool& instrument;
};

/// Linear light, red green blue. Mean of 2 x 2 rays per pixel;
/// black without a surface. Evaluates new triangles of `skin`.
Raster<Eigen::Vector3f> renderView(const ScopeScene& scene, TissueSkin& skin,
                                   const ScopeSurroundings& around, const ScopeEye& eye);

/// Intersections of the rays through the pixel centres of the left camera.
Raster<RayHit> castCentres(const ScopeScene& scene, const ScopeLens& left);

/// Interpolated tissue normals at these intersections; 0 without an intersection.
Raster<Eigen::Vector3f> normalsOf(const Raster<RayHit>& hits, const ScopeScene& scene);

/// Non-zero for pixels whose tissue is occluded by the instrument.
Mask instrumentMask(const Raster<RayHit>& hits, const ScopeTool& instrument, const ScopeLens& left);

/// Depth in mm of these intersections, computed in double; NaN without an intersection.
Raster<float> depthOf(const Raster<RayHit>& hits, const ScopeScene& scene, const ScopeLens& left);

}  // namespace softscope
