// tests/mesh/mesh_repair_test.cpp: inserted flaws are found, reported and repaired, or rejected.
#include "mesh/mesh_repair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/made_shapes.h"
#include "mesh/mesh_check.h"
#include "open_mesh_check.h"

namespace softscope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TriangleMesh ball() { return makeSphere(24, 11, 30); }

/// No flaw is left, and the body has the volume that it should have.
void expectSound(const TriangleMesh& mesh, double volume_mm3) {
  const MeshCheck check = checkMesh(mesh);
  EXPECT_THAT(meshWarnings(check), IsEmpty());
  EXPECT_EQ(test::openMeshComplaint(mesh), "");
  EXPECT_NEAR(check.volume_mm3 / volume_mm3, 1, 0.01);
}

double volumeOfBall() { return checkMesh(ball()).volume_mm3; }

TEST(MeshRepair, LeavesASoundMeshAsItIs) {
  const TriangleMesh before = ball();
  const RepairedMesh after = repairMesh(before, "ball");
  EXPECT_THAT(after.repairs, IsEmpty());
  EXPECT_EQ(after.mesh.vertices_mm, before.vertices_mm);
  EXPECT_EQ(after.mesh.triangles, before.triangles);
}

TEST(MeshRepair, JoinsTrianglesThatNameTheirOwnCorners) {
  TriangleMesh soup;
  for (const Triangle& t : ball().triangles) {
    const auto first = static_cast<std::int32_t>(soup.vertices_mm.size());
    for (const std::int32_t corner : t) soup.vertices_mm.push_back(ball().vertices_mm[corner]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const RepairedMesh repaired = repairMesh(soup, "soup");
  expectSound(repaired.mesh, volumeOfBall());
  EXPECT_EQ(repaired.mesh.vertices_mm.size(), ball().vertices_mm.size());
  EXPECT_THAT(repaired.repairs,
              ElementsAre(HasSubstr("doubled vertices"), HasSubstr("that no triangle names")));
}

TEST(MeshRepair, TurnsWhatFacesAgainstItsNeighbours) {
  TriangleMesh mesh = ball();
  for (const int i : {3, 50, 51, 120}) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  const RepairedMesh repaired = repairMesh(mesh, "ball");
  expectSound(repaired.mesh, volumeOfBall());
  EXPECT_THAT(repaired.repairs, ElementsAre("turned 4 triangles that faced against their "
                                            "neighbours"));
}

TEST(MeshRepair, TurnsWhatIsInsideOut) {
  TriangleMesh mesh = ball();
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  const RepairedMesh repaired = repairMesh(mesh, "ball");
  expectSound(repaired.mesh, volumeOfBall());
  EXPECT_THAT(repaired.repairs, ElementsAre(HasSubstr("inside out")));
}

TEST(MeshRepair, ClosesHoles) {
  TriangleMesh one = ball(), many = ball();
  one.triangles.erase(one.triangles.begin() + 100);
  const RepairedMesh small = repairMesh(one, "ball");
  expectSound(small.mesh, volumeOfBall());
  EXPECT_EQ(small.mesh.vertices_mm.size(), ball().vertices_mm.size());
  EXPECT_THAT(small.repairs, ElementsAre(HasSubstr("closed 1 holes of 3 edges")));
  const std::int32_t middle = many.triangles[100][0];
  const auto around = [&](const Triangle& t) {
    return std::find(t.begin(), t.end(), middle) != t.end();
  };
  many.triangles.erase(std::remove_if(many.triangles.begin(), many.triangles.end(), around),
                       many.triangles.end());
  const RepairedMesh large = repairMesh(many, "ball");
  expectSound(large.mesh, volumeOfBall());
  EXPECT_THAT(large.repairs,
              ElementsAre(HasSubstr("closed 1 holes of 6 edges"), HasSubstr("dropped 1 vertices")));
}

TEST(MeshRepair, LeavesAWideOpeningOpenAndSaysSo) {
  const TriangleMesh patch = makeRectangle(10, 20, 5, 7);
  const RepairedMesh repaired = repairMesh(patch, "patch");
  EXPECT_EQ(repaired.mesh.triangles, patch.triangles);
  EXPECT_THAT(repaired.repairs, ElementsAre(HasSubstr("left 1 holes open")));
}

TEST(MeshRepair, DropsFoldedAndDoubledTrianglesAndUnusedVertices) {
  TriangleMesh mesh = ball();
  mesh.triangles.push_back({4, 4, 5});
  mesh.triangles.push_back(mesh.triangles[7]);
  mesh.vertices_mm.emplace_back(1, 2, 3);
  const RepairedMesh repaired = repairMesh(mesh, "ball");
  expectSound(repaired.mesh, volumeOfBall());
  EXPECT_EQ(repaired.mesh.triangles, ball().triangles);
  EXPECT_EQ(repaired.mesh.vertices_mm, ball().vertices_mm);
  EXPECT_THAT(repaired.repairs, ElementsAre(HasSubstr("dropped 1 triangles that name"),
                                            HasSubstr("dropped 1 triangles that were there"),
                                            HasSubstr("dropped 1 vertices")));
}

TEST(MeshRepair, PartsSheetsThatTouchInAPoint) {
  TriangleMesh mesh = ball();
  const auto offset = static_cast<std::int32_t>(mesh.vertices_mm.size());
  // A second ball next to the first shares the vertex where they touch.
  std::int32_t outermost = 0;
  for (std::int32_t i = 0; i < offset; ++i)
    if (mesh.vertices_mm[i].x() > mesh.vertices_mm[outermost].x()) outermost = i;
  const Eigen::Vector3f touch = mesh.vertices_mm[outermost];
  const auto triangles = mesh.triangles;
  for (std::int32_t i = 0; i < offset; ++i)
    mesh.vertices_mm.push_back(2 * touch - mesh.vertices_mm[i]);
  for (const Triangle& t : triangles) {
    Triangle mirrored{t[0] + offset, t[2] + offset, t[1] + offset};
    for (std::int32_t& vertex : mirrored)
      if (vertex == outermost + offset) vertex = outermost;
    mesh.triangles.push_back(mirrored);
  }
  ASSERT_EQ(checkMesh(mesh).split_vertices, 1u);
  const RepairedMesh repaired = repairMesh(mesh, "two balls");
  expectSound(repaired.mesh, 2 * volumeOfBall());
  EXPECT_EQ(checkMesh(repaired.mesh).components, 2u);
  EXPECT_THAT(repaired.repairs,
              ElementsAre(HasSubstr("touched in 1 points"), HasSubstr("dropped 1 vertices")));
}

TEST(MeshRepair, KeepsACavity) {
  TriangleMesh mesh = ball();
  const auto offset = static_cast<std::int32_t>(mesh.vertices_mm.size());
  for (const Eigen::Vector3f& p : ball().vertices_mm) mesh.vertices_mm.push_back(0.5F * p);
  for (const Triangle& t : ball().triangles)
    mesh.triangles.push_back({t[0] + offset, t[2] + offset, t[1] + offset});
  EXPECT_THAT(repairMesh(mesh, "shell").repairs, IsEmpty());
}

TEST(MeshRepair, RefusesWhatHasNoInside) {
  const auto message = [](const TriangleMesh& mesh) -> std::string {
    try {
      repairMesh(mesh, "organ.stl");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  TriangleMesh wall = ball();  // with a fin
  wall.vertices_mm.emplace_back(0, 0, 60);
  wall.triangles.push_back(
      {ball().triangles[9][0], ball().triangles[9][1], std::int32_t(wall.vertices_mm.size()) - 1});
  EXPECT_THAT(message(wall), testing::StartsWith("organ.stl: 1 edges belong to more than two"));
  TriangleMesh strip;  // five squares round, the last twisted
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * M_PI * i / 5, tilt = angle / 2;
    for (const double side : {-4.0, 4.0}) {
      const double r = 20 + side * std::cos(tilt);
      strip.vertices_mm.emplace_back(float(r * std::cos(angle)), float(r * std::sin(angle)),
                                     float(side * std::sin(tilt)));
    }
  }
  for (std::int32_t i = 0; i < 5; ++i) {
    const bool last = i == 4;
    const std::int32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  EXPECT_THAT(message(strip), HasSubstr("one side only"));
  TriangleMesh nothing;
  nothing.vertices_mm.assign(3, Eigen::Vector3f::Zero());
  nothing.triangles = {{0, 0, 1}};
  EXPECT_THAT(message(nothing), HasSubstr("organ.stl"));
}

}  // namespace
}  // namespace softscope
