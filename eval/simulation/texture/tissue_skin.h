// eval/simulation/texture/tissue_skin.h: texture atlas, painted for each triangle that a camera
// sees.
#pragma once

#include <memory>
#include <vector>

#include "eval/simulation/texture/tissue_texture.h"
#include "eval/simulation/tissue/tissue_body.h"

namespace softscope {

/// The tissue at a place of a triangle, and how its relief rises along the triangle's edges.
struct SkinSample {
  Eigen::Vector3f albedo;
  float wetness;
  float rise_along_ab_mm;  // change of the relief from a to b, were the slope the same all the way
  float rise_along_ac_mm;
};

/// Each triangle (a, b, c) carries its own triangular grid of texels, evaluated at the undeformed
/// places; neighbours agree along their edge. Texels are painted when they are first needed, and
/// their values depend neither on when nor on which thread.
class TissueSkin {
 public:
  /// `texel_mm`: the grid is no coarser. Copies the mesh.
  TissueSkin(const TissueBody& body, TissueTexture texture, double texel_mm);

  /// Paints those of `triangles` that aren't yet; each at most once in the list.
  void paint(const std::vector<std::int32_t>& triangles);

  /// At a + u (b - a) + v (c - a) of a painted triangle.
  SkinSample sample(std::int32_t triangle, float u, float v) const;

 private:
  struct Patch {
    int cells = 0;  // along an edge
    std::vector<TissuePoint> texels;

    const TissuePoint& at(int i, int j) const {
      return texels[j * (cells + 1) - j * (j - 1) / 2 + i];
    }
  };
  Patch painted(std::int32_t triangle) const;

  TriangleMesh rest_mesh_;
  std::vector<Eigen::Vector3f> rest_normals_;  // one a vertex
  std::vector<float> depth_mm_;                // one a vertex; empty: skin all over
  TissueTexture texture_;
  double texel_mm_;
  std::vector<Patch> patches_;  // one a triangle
};

}  // namespace softscope
