// tests/simulation/organ_mesh_test.cpp: the built-in organ is a sound surface.
#include "eval/simulation/tissue/organ_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>

#include "core/error.h"

namespace softscope {
namespace {

TEST(OrganMesh, IsClosedAndFacesOutward) {
  const TriangleMesh organ = makeOrganMesh({}, 3);
  std::map<std::pair<int, int>, int> directed;
  double volume_mm3 = 0;
  for (const Triangle& t : organ.triangles) {
    for (int side = 0; side < 3; ++side) ++directed[{t[side], t[(side + 1) % 3]}];
    const Eigen::Vector3f &a = organ.vertices_mm[t[0]], &b = organ.vertices_mm[t[1]],
                          &c = organ.vertices_mm[t[2]];
    volume_mm3 += a.dot(b.cross(c)) / 6;
  }
  for (const auto& [edge, count] : directed) {
    EXPECT_EQ(count, 1);                                       // oriented alike
    EXPECT_EQ(directed.count({edge.second, edge.first}), 1u);  // closed
  }
  EXPECT_GT(volume_mm3, 30000);  // the ellipsoid alone has 59,700; lobes and folds take their share
  EXPECT_LT(volume_mm3, 90000);
}

TEST(OrganMesh, HasTheSizeThatWasAskedFor) {
  const TriangleMesh organ = makeOrganMesh({}, 3);
  EXPECT_NEAR(double(organ.vertices_mm.size()), 20000, 500);
  Eigen::Array3f low = organ.vertices_mm[0].array(), high = low;
  for (const Eigen::Vector3f& v : organ.vertices_mm) {
    low = low.min(v.array());
    high = high.max(v.array());
  }
  EXPECT_NEAR((high - low).maxCoeff(), 60, 8);  // lobes of 3 mm on both ends, and folds
}

TEST(OrganMesh, DependsOnItsSeedAlone) {
  const OrganOptions coarse{60, 10, 3, 1.4};
  EXPECT_EQ(makeOrganMesh(coarse, 3).vertices_mm, makeOrganMesh(coarse, 3).vertices_mm);
  EXPECT_NE(makeOrganMesh(coarse, 3).vertices_mm, makeOrganMesh(coarse, 4).vertices_mm);
}

TEST(OrganMesh, RefusesImpossibleSizes) {
  EXPECT_THROW(makeOrganMesh({0, 10, 3, 1}, 1), OptionError);
  EXPECT_THROW(makeOrganMesh({60, 1, 3, 1}, 1), OptionError);
  EXPECT_THROW(makeOrganMesh({60, 10, 30, 1}, 1), OptionError);
  EXPECT_THROW(makeOrganMesh({60, 10, 3, -1}, 1), OptionError);
}

}  // namespace
}  // namespace softscope
