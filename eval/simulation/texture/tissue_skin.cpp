// eval/simulation/texture/tissue_skin.cpp: texels on barycentric grids.
#include "eval/simulation/texture/tissue_skin.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kMostCells = 256;  // per triangle edge

SkinSample blend(const TissuePoint& a, const TissuePoint& b, const TissuePoint& c, float wa,
                 float wb, float wc) {
  SkinSample sample;
  sample.albedo = wa * a.albedo + wb * b.albedo + wc * c.albedo;
  sample.wetness = wa * a.wetness + wb * b.wetness + wc * c.wetness;
  return sample;
}

template <class Value>
Value mixed(const std::vector<Value>& values, const Triangle& t, float u, float v) {
  return (1 - u - v) * values[t[0]] + u * values[t[1]] + v * values[t[2]];
}

}  // namespace

TissueSkin::TissueSkin(const TissueBody& body, TissueTexture texture, double texel_mm)
    : rest_mesh_(body.mesh),
      rest_normals_(body.normalsOf(body.mesh.vertices_mm)),
      depth_mm_(body.depth_mm),
      texture_(std::move(texture)),
      texel_mm_(texel_mm),
      patches_(rest_mesh_.triangles.size()) {}

void TissueSkin::paint(const std::vector<std::int32_t>& triangles) {
  parallelRanges(static_cast<int>(triangles.size()), 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      if (patches_[triangles[i]].cells == 0) patches_[triangles[i]] = painted(triangles[i]);
  });
}

TissueSkin::Patch TissueSkin::painted(std::int32_t triangle) const {
  const Triangle& t = rest_mesh_.triangles[triangle];
  const Eigen::Vector3f& a = rest_mesh_.vertices_mm[t[0]];
  const Eigen::Vector3f ab = rest_mesh_.vertices_mm[t[1]] - a,
                        ac = rest_mesh_.vertices_mm[t[2]] - a;
  const double longest_mm = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
  Patch patch;
  patch.cells = std::clamp(static_cast<int>(std::ceil(longest_mm / texel_mm_)), 1, kMostCells);
  const float step = 1.0F / float(patch.cells);
  for (int j = 0; j <= patch.cells; ++j)
    for (int i = 0; i <= patch.cells - j; ++i) {
      const float u = float(i) * step, v = float(j) * step;
      patch.texels.push_back(texture_.at(a + u * ab + v * ac, mixed(rest_normals_, t, u, v),
                                         depth_mm_.empty() ? 0 : mixed(depth_mm_, t, u, v)));
    }
  return patch;
}

SkinSample TissueSkin::sample(std::int32_t triangle, float u, float v) const {
  const Patch& patch = patches_[triangle];
  const int n = patch.cells;
  const float x = std::clamp(u, 0.0F, 1.0F) * float(n), y = std::clamp(v, 0.0F, 1.0F) * float(n);
  const int j = std::min(static_cast<int>(y), n - 1);
  const int i = std::min(static_cast<int>(x), n - 1 - j);
  const float fx = std::min(x - float(i), 1.0F), fy = std::min(y - float(j), 1.0F);
  const TissuePoint &right = patch.at(i + 1, j), &up = patch.at(i, j + 1);
  if (fx + fy <= 1 || i + j >= n - 1) {
    const TissuePoint& corner = patch.at(i, j);
    SkinSample sample = blend(corner, right, up, 1 - fx - fy, fx, fy);
    sample.rise_along_ab_mm = (right.relief_mm - corner.relief_mm) * float(n);
    sample.rise_along_ac_mm = (up.relief_mm - corner.relief_mm) * float(n);
    return sample;
  }
  const TissuePoint& corner = patch.at(i + 1, j + 1);
  SkinSample sample = blend(corner, up, right, fx + fy - 1, 1 - fx, 1 - fy);
  sample.rise_along_ab_mm = (corner.relief_mm - up.relief_mm) * float(n);
  sample.rise_along_ac_mm = (corner.relief_mm - right.relief_mm) * float(n);
  return sample;
}

}  // namespace softscope
