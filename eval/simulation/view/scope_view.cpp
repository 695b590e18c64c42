// eval/simulation/view/scope_view.cpp: ray casting, texture evaluation, shading.
#include "eval/simulation/view/scope_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>

#include "core/parallel.h"

namespace softscope {
namespace {

/// Four rays per pixel, offset by a quarter of a pixel.
RayPacket raysOf(const ScopeEye& eye, int u, int v) {
  return {eye.ray(u - 0.25, v - 0.25), eye.ray(u + 0.25, v - 0.25), eye.ray(u - 0.25, v + 0.25),
          eye.ray(u + 0.25, v + 0.25)};
}

Raster<PacketHits> castViews(const ScopeScene& scene, const ScopeEye& eye) {
  Raster<PacketHits> hits(eye.lens.camera.width_px, eye.lens.camera.height_px);
  parallelRows(hits.height_px, [&](int v) {
    for (int u = 0; u < hits.width_px; ++u)
      hits.at(u, v) = scene.tree.cast(eye.centre_mm, raysOf(eye, u, v));
  });
  return hits;
}

float limitOf(const RayHit& hit) {
  return hit.met() ? hit.distance : std::numeric_limits<float>::max();
}

std::vector<std::int32_t> seenTriangles(const Raster<PacketHits>& hits, std::size_t triangles) {
  std::vector<bool> seen(triangles, false);
  std::vector<std::int32_t> list;
  for (const PacketHits& packet : hits.values)
    for (const RayHit& hit : packet)
      if (hit.met() && !seen[hit.triangle]) {
        seen[hit.triangle] = true;
        list.push_back(hit.triangle);
      }
  return list;
}

/// Gradient in space of a relief with the given changes along two edges.
Eigen::Vector3f slopeOf(const Eigen::Vector3f& ab, const Eigen::Vector3f& ac, float rise_ab,
                        float rise_ac) {
  const float bb = ab.squaredNorm(), bc = ab.dot(ac), cc = ac.squaredNorm();
  const float determinant = std::max(bb * cc - bc * bc, 1e-12F);
  return ((cc * rise_ab - bc * rise_ac) * ab + (bb * rise_ac - bc * rise_ab) * ac) / determinant;
}

Eigen::Vector3f smoothNormal(const ScopeScene& scene, const RayHit& hit) {
  const Triangle& t = scene.triangles[hit.triangle];
  return (1 - hit.u - hit.v) * scene.normals[t[0]] + hit.u * scene.normals[t[1]] +
         hit.v * scene.normals[t[2]];
}

LitPoint litPoint(const ScopeScene& scene, const TissueSkin& skin, float relief,
                  const RayHit& hit) {
  const Triangle& t = scene.triangles[hit.triangle];
  const Eigen::Vector3f& a = scene.vertices_mm[t[0]];
  const Eigen::Vector3f ab = scene.vertices_mm[t[1]] - a, ac = scene.vertices_mm[t[2]] - a;
  const SkinSample tissue = skin.sample(hit.triangle, hit.u, hit.v);
  const Eigen::Vector3f smooth = smoothNormal(scene, hit);
  const Eigen::Vector3f slope = slopeOf(ab, ac, tissue.rise_along_ab_mm, tissue.rise_along_ac_mm);
  LitPoint point;
  point.position_mm = a + hit.u * ab + hit.v * ac;
  point.normal = (smooth.normalized() - relief * slope).normalized();
  point.albedo = tissue.albedo;
  point.wetness = tissue.wetness;
  return point;
}

}  // namespace

ScopeScene::ScopeScene(std::vector<Eigen::Vector3f> vertices_left_mm, const TissueBody& body,
                       float open)
    : vertices_mm(std::move(vertices_left_mm)),
      triangles(body.mesh.triangles),
      normals(body.normalsOf(vertices_mm)),
      tree(vertices_mm, body.visibleTriangles(open)) {}

Raster<Eigen::Vector3f> renderView(const ScopeScene& scene, TissueSkin& skin,
                                   const ScopeSurroundings& around, const ScopeEye& eye) {
  const Raster<PacketHits> hits = castViews(scene, eye);
  skin.paint(seenTriangles(hits, scene.triangles.size()));
  const auto relief = static_cast<float>(around.relief);
  const auto seen = [&](const RayHit& hit, const Eigen::Vector3f& ray) -> Eigen::Vector3f {
    if (around.instrument.there())
      if (const auto steel = around.instrument.meet(eye.centre_mm, ray, limitOf(hit)))
        return around.light.shadeSteel(eye.centre_mm + steel->distance * ray, steel->normal,
                                       eye.centre_mm);
    if (!hit.met()) return Eigen::Vector3f::Zero();
    return around.light.shade(litPoint(scene, skin, relief, hit), eye.centre_mm);
  };
  Raster<Eigen::Vector3f> view(hits.width_px, hits.height_px, Eigen::Vector3f::Zero());
  parallelRows(view.height_px, [&](int v) {
    for (int u = 0; u < view.width_px; ++u) {
      const RayPacket rays = raysOf(eye, u, v);
      for (int i = 0; i < 4; ++i) view.at(u, v) += 0.25F * seen(hits.at(u, v)[i], rays[i]);
    }
  });
  return view;
}

Raster<Eigen::Vector3f> normalsOf(const Raster<RayHit>& hits, const ScopeScene& scene) {
  Raster<Eigen::Vector3f> normals(hits.width_px, hits.height_px, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits.values[i].met()) normals.values[i] = smoothNormal(scene, hits.values[i]).normalized();
  return normals;
}

Mask instrumentMask(const Raster<RayHit>& hits, const ScopeTool& instrument,
                    const ScopeLens& left) {
  Mask mask(hits.width_px, hits.height_px, 0);
  if (!instrument.there()) return mask;
  parallelRows(mask.height_px, [&](int v) {
    for (int u = 0; u < mask.width_px; ++u)
      if (instrument.meet(Eigen::Vector3f::Zero(), left.ray(u, v).cast<float>(),
                          limitOf(hits.at(u, v))))
        mask.at(u, v) = 255;
  });
  return mask;
}

Raster<RayHit> castCentres(const ScopeScene& scene, const ScopeLens& left) {
  const int width = left.camera.width_px;
  Raster<RayHit> hits(width, left.camera.height_px);
  parallelRows(hits.height_px, [&](int v) {
    for (int u = 0; u < width; u += 4) {
      RayPacket rays;
      for (int i = 0; i < 4; ++i) rays[i] = left.ray(u + i, v).cast<float>();
      const PacketHits found = scene.tree.cast(Eigen::Vector3f::Zero(), rays);
      for (int i = 0; i < std::min(4, width - u); ++i) hits.at(u + i, v) = found[i];
    }
  });
  return hits;
}

Raster<float> depthOf(const Raster<RayHit>& hits, const ScopeScene& scene, const ScopeLens& left) {
  Raster<float> depth_mm(hits.width_px, hits.height_px, std::numeric_limits<float>::quiet_NaN());
  for (int v = 0; v < hits.height_px; ++v)
    for (int u = 0; u < hits.width_px; ++u) {
      const RayHit& hit = hits.at(u, v);
      if (!hit.met()) continue;
      const Triangle& t = scene.triangles[hit.triangle];
      const Eigen::Vector3d a = scene.vertices_mm[t[0]].cast<double>();
      const Eigen::Vector3d normal = (scene.vertices_mm[t[1]].cast<double>() - a)
                                         .cross(scene.vertices_mm[t[2]].cast<double>() - a);
      const Eigen::Vector3d ray = left.ray(u, v);
      depth_mm.at(u, v) = static_cast<float>(normal.dot(a) / normal.dot(ray));
    }
  return depth_mm;
}

}  // namespace softscope
