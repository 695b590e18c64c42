// eval/simulation/texture/tissue_skin.h: texture
// atlas, evaluated for each visible triangle.
#pragma once

#include <memory>
#include <vector>

#include "eval/simulation/texture/tissue_texture.h"
#include "eval/simulation/tissue/tissue_body.h"

namespace softscope {

/// Tissue at a position of a triangle, with the slope of the relief along the edges.
struct SkinSample {
  Eigen::Vector3f albedo;
  float wetness;
  float rise_along_ab_mm;  // change of the relief from a to b for a constant slope
  float rise_along_ac_mm;
};

/// Each triangle (a, b, c) has a triangular grid of texels, evaluated at
/// undeformed positions; neighbouring triangles agree along their edge. Texels are
/// evaluated on first use, and their values depend neither on time nor on thread.
class TissueSkin {
 public:
  /// `texel_mm`: maximum grid spacing. Copies the mesh.
  TissueSkin(const TissueBody& body, TissueTexture texture, double texel_mm);

  /// Evaluates those of `triangles` that are new; each triangle at most once in the list.
  void paint(const std::vector<std::int32_t>& triangles);

  /// At a + u (b - a) + v (c - a) of an evaluated triangle.
  SkinSample sample(std::int32_t triangle, float u, float v) const;

 private:
  struct Patch {
    int cells = 0;  // per edge
    std::vector<TissuePoint> texels;

    const TissuePoint& at(int i, int j) const {
      return texels[j * (cells + 1) - j * (j - 1) / 2 + i];
    }
  };
  Patch painted(std::int32_t triangle) const;

  TriangleMesh rest_mesh_;
  std::vector<Eigen::Vector3f> rest_normals_;  // one per vertex
  std::vector<float> depth_mm_;                // one per vertex; empty: skin only
  TissueTexture texture_;
  double texel_mm_;
  std::vector<Patch> patches_;  // one per triangle
};

}  // namespace softscope
