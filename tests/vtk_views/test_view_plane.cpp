// tests/vtk_views/test_view_plane.cpp: orientation of views, and their letters.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {
namespace {

using Eigen::Vector3d;
constexpr SceneFrame kPatient = SceneFrame::kPatient;
constexpr SideRule kRadiological = SideRule::kRadiological;

std::string sides(const ViewPlane& view, SceneFrame frame = kPatient) {
  return sideName(-view.right, frame) + " " + sideName(view.right, frame) + " " +
         sideName(view.up, frame) + " " + sideName(-view.up, frame);
}

TEST(ViewPlane, RadiologicalViewsFaceThePatient) {
  const Vector3d o = Vector3d::Zero();
  EXPECT_EQ(sides(axialView(o, kPatient, kRadiological)), "R L A P");
  EXPECT_EQ(sides(coronalView(o, kPatient, kRadiological)), "R L S I");
  EXPECT_EQ(sides(sagittalView(o, kPatient)), "A P S I");
  EXPECT_EQ(sideName(axialView(o, kPatient, kRadiological).towardsViewer(), kPatient), "I");
  EXPECT_EQ(sideName(coronalView(o, kPatient, kRadiological).towardsViewer(), kPatient), "A");
  EXPECT_EQ(sideName(sagittalView(o, kPatient).towardsViewer(), kPatient), "L");
}

TEST(ViewPlane, NeurologicalViewsHaveLeftOnTheLeft) {
  const auto rule = SideRule::kNeurological;
  EXPECT_EQ(sides(axialView({0, 0, 0}, kPatient, rule)), "L R A P");
  EXPECT_EQ(sides(coronalView({0, 0, 0}, kPatient, rule)), "L R S I");
}

TEST(ViewPlane, ObliqueViewsLookFromTheNearestStandardSideAndShowDoubles) {
  const ViewPlane tilted = obliqueView({0, 0, 0}, {0, 0.6, 0.8}, kPatient, kRadiological);
  EXPECT_EQ(sides(tilted), "R L AS PI");
  EXPECT_LT(tilted.towardsViewer().z(), 0) << "from the feet, as an axial view";
  const ViewPlane other = obliqueView({0, 0, 0}, {0, -0.6, -0.8}, kPatient, kRadiological);
  EXPECT_TRUE(other.right.isApprox(tilted.right)) << "a plane has two normals, but one picture";
  for (const Vector3d& normal : {Vector3d(1, 0.2, 0.1), {0.3, 1, 0.2}, {1, 1, 1}, {0, 0, -2}}) {
    const ViewPlane view = obliqueView({1, 2, 3}, normal, kPatient, kRadiological);
    EXPECT_NEAR(std::abs(view.towardsViewer().dot(normal.normalized())), 1, 1e-12);
    EXPECT_NEAR(view.right.dot(view.up), 0, 1e-12);
  }
  EXPECT_THROW(obliqueView({0, 0, 0}, {0, 0, 0}, kPatient, kRadiological), OptionError);
}

TEST(ViewPlane, ObliqueViewsHaveLeftWhereTheOthersHaveIt) {
  for (const Vector3d& normal : {Vector3d(1, 1, 2),
                                 {1, 1, 1.01},
                                 {1, 1, 1},
                                 {1, 1, 0},
                                 {1, 0.9, 0},
                                 {0.9, 1, 0},
                                 {-1, -1, -1},
                                 {1, -0.5, 0.2},
                                 {-0.3, 0.1, 0.2}}) {
    const ViewPlane radiological = obliqueView({0, 0, 0}, normal, kPatient, kRadiological);
    EXPECT_GT(radiological.right.x(), 0.26) << normal.transpose();
    const ViewPlane other = obliqueView({0, 0, 0}, normal, kPatient, SideRule::kNeurological);
    EXPECT_LT(other.right.x(), -0.26) << normal.transpose();
    EXPECT_GT(other.up.dot(radiological.up), 0.99);
  }
  for (const Vector3d& normal : {Vector3d(1, 0.2, 0), {-1, -0.2, 0.1}, {1, -0.2, -0.1}}) {
    const ViewPlane view = obliqueView({0, 0, 0}, normal, kPatient, kRadiological);
    EXPECT_GT(view.right.y(), 0.9) << "as a sagittal view, the back on the right";
  }
}

TEST(ViewPlane, LettersComeFromTheDirection) {
  EXPECT_EQ(sideName({1, 0.1, 0}, kPatient), "L") << "6 degrees aren't named";
  EXPECT_EQ(sideName({-1, 0.5, 0}, kPatient), "RP");
  EXPECT_EQ(sideName({-1, 0.9, 0.8}, kPatient), "RPS");
  EXPECT_EQ(sideName({0, 0, 1}, SceneFrame::kCamera), "far");
  EXPECT_EQ(sideName({0, -1, 0.5}, SceneFrame::kAxes), "-y");
  EXPECT_EQ(sideName({1, -0.9, 0}, SceneFrame::kCamera), "right");
}

TEST(ViewPlane, PositionsCarryTheirSide) {
  EXPECT_EQ(positionText(axialView({1, 2, -30.25}, kPatient, kRadiological), kPatient),
            "I 30.2 mm");
  EXPECT_EQ(positionText(sagittalView({12.5, 0, 0}, kPatient), kPatient), "L 12.5 mm");
  EXPECT_EQ(positionText(coronalView({0, -3, 0}, kPatient, kRadiological), kPatient), "A 3.0 mm");
  EXPECT_EQ(positionText(obliqueView({0, 0, 0}, {0, 1, 1}, kPatient, kRadiological), kPatient), "");
}

TEST(ViewPlane, APlaceIsToldBySidesWhereTheyAreKnown) {
  EXPECT_EQ(sidesText({-1.25, 0, 3}, 1, kPatient), "R 1.2, P 0.0, S 3.0");
  EXPECT_EQ(sidesText({-0.5, 0.25, 1}, 2, SceneFrame::kAxes), "x -0.50, y 0.25, z 1.00");
}

TEST(ViewPlane, AnUnknownSpaceHasNoAnatomicalPlanes) {
  const auto frame = SceneFrame::kAxes;
  EXPECT_EQ(axialView({0, 0, 0}, frame, kRadiological).name, "xy plane");
  EXPECT_EQ(coronalView({0, 0, 0}, frame, kRadiological).name, "xz plane");
  EXPECT_EQ(sagittalView({0, 0, 0}, frame).name, "yz plane");
  EXPECT_EQ(sides(coronalView({0, 0, 0}, frame, kRadiological), frame), "-x +x +z -z");
}

TEST(ViewPlane, AScopesSceneIsSeenAsTheScopeSeesIt) {
  const auto frame = SceneFrame::kCamera;
  EXPECT_EQ(sides(axialView({0, 0, 0}, frame, kRadiological), frame), "left right up down");
  EXPECT_EQ(sides(coronalView({0, 0, 0}, frame, kRadiological), frame), "left right far near");
  EXPECT_EQ(sides(sagittalView({0, 0, 0}, frame), frame), "near far up down");
}

}  // namespace
}  // namespace softscope
