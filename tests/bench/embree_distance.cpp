// tests/bench/embree_distance.cpp: a point query whose callback measures one triangle.
#include "bench/embree_distance.h"

#ifdef SOFTSCOPE_HAS_EMBREE
#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace softscope::test {
namespace {

/// Closest point on a triangle by Voronoi regions (Ericson, Real-Time Collision Detection, 5.1.5).
Eigen::Vector3f closestOn(const Eigen::Vector3f& p, const Eigen::Vector3f& a,
                          const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector3f ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp);
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const float scale = 1 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

struct Query {
  const TriangleMesh* mesh;
  float least_mm;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  Query& query = *static_cast<Query*>(arguments->userPtr);
  const Triangle& t = query.mesh->triangles[arguments->primID];
  const auto& v = query.mesh->vertices_mm;
  const Eigen::Vector3f p(arguments->query->x, arguments->query->y, arguments->query->z);
  const float distance_mm = (p - closestOn(p, v[t[0]], v[t[1]], v[t[2]])).norm();
  if (distance_mm >= query.least_mm) return false;
  query.least_mm = arguments->query->radius = distance_mm;
  return true;
}

class Embree : public EmbreeDistance {
 public:
  explicit Embree(const TriangleMesh& mesh)
      : mesh_(mesh), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh_.vertices_mm.size()));
    for (const Eigen::Vector3f& v : mesh_.vertices_mm)
      vertices = std::copy(v.data(), v.data() + 3, vertices);
    auto* corners = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh_.triangles.size()));
    for (const Triangle& t : mesh_.triangles) corners = std::copy(t.begin(), t.end(), corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
  }
  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  double distance(const Eigen::Vector3f& point_mm) const override {
    RTCPointQuery point{point_mm.x(), point_mm.y(), point_mm.z(), 0, HUGE_VALF};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Query query{&mesh_, HUGE_VALF};
    rtcPointQuery(scene_, &point, &context, visit, &query);
    return query.least_mm;
  }

 private:
  TriangleMesh mesh_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

std::unique_ptr<EmbreeDistance> makeEmbreeDistance(const TriangleMesh& mesh) {
  return std::make_unique<Embree>(mesh);
}

}  // namespace softscope::test

#else

namespace softscope::test {
std::unique_ptr<EmbreeDistance> makeEmbreeDistance(const TriangleMesh&) { return nullptr; }
}  // namespace softscope::test

#endif
