// tests/simulation/deformation_test.cpp: how far, how smoothly and how often tissue moves.
#include <gtest/gtest.h>

#include "core/error.h"
#include "eval/simulation/tissue/organ_mesh.h"
#include "eval/simulation/tissue/tissue_deformation.h"

namespace softscope {
namespace {

const Eigen::Vector3f kFocus_mm(0, 0, 18);

float largestShift(const std::vector<Eigen::Vector3f>& a, const std::vector<Eigen::Vector3f>& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

DeformationOptions still() {
  DeformationOptions options;
  options.breathing.amplitude_mm = options.heartbeat.amplitude_mm = options.push.amplitude_mm = 0;
  return options;
}

class Deformation : public ::testing::Test {
 protected:
  std::vector<Eigen::Vector3f> at(const DeformationOptions& options, double time_s) const {
    return TissueDeformation(organ_, kFocus_mm, options, 7).verticesAt(time_s);
  }
  TriangleMesh organ_ = makeOrganMesh({60, 20, 3, 1.4}, 1);
};

TEST_F(Deformation, RestsAtTheStartAndWhereItIsOff) {
  EXPECT_EQ(at({}, 0), organ_.vertices_mm);
  EXPECT_EQ(at(still(), 0.77), organ_.vertices_mm);
}

TEST_F(Deformation, BreathingAndHeartbeatComeBackAfterTheirPeriod) {
  DeformationOptions breathing = still(), beating = still();
  breathing.breathing = {2, 3.5};
  beating.heartbeat = {1, 0.8};
  // 1e-5 mm is the rounding of float at 30 mm.
  EXPECT_LT(largestShift(at(breathing, 3.5), organ_.vertices_mm), 1e-5);
  EXPECT_LT(largestShift(at(beating, 1.6), organ_.vertices_mm), 1e-5);
  EXPECT_GT(largestShift(at(breathing, 1.75), organ_.vertices_mm), 1.0);
  // At its height a beat moves the focus by the amplitude, and nothing by more.
  EXPECT_NEAR(largestShift(at(beating, 0.16), organ_.vertices_mm), 1.0, 0.05);
}

TEST_F(Deformation, PushesMoveAPlaceByTwoToThreeMillimetresAndLetItGo) {
  DeformationOptions pushed = still();
  pushed.push = {2.5, 1};
  const float first_mm = largestShift(at(pushed, 1.0), organ_.vertices_mm);
  EXPECT_GE(first_mm, 2.0 - 1e-4);
  EXPECT_LE(first_mm, 3.0 + 1e-4);
  // Never more than three pushes are at work: 3 mm, and shares of two on their way back.
  for (int i = 0; i < 40; ++i)
    EXPECT_LE(largestShift(at(pushed, 0.37 * i), organ_.vertices_mm), 6.0);
}

TEST_F(Deformation, IsSmoothInSpaceAndTime) {
  const auto moved = at({}, 2.13);
  for (const Triangle& t : organ_.triangles) {
    const Eigen::Vector3f rest = organ_.vertices_mm[t[1]] - organ_.vertices_mm[t[0]];
    const Eigen::Vector3f now = moved[t[1]] - moved[t[0]];
    // 3 mm over a spread of 9 mm strains by at most 3 / 9 * exp(-1/2) = 0.2; three pushes together,
    // breath and beat stay below half.
    EXPECT_NEAR(now.norm() / rest.norm(), 1, 0.5);
  }
  // 3 mm in 0.8 s by a cubic: at most 5.6 mm/s; three pushes, breath and beat (7 mm/s): 25 mm/s.
  for (double time_s = 0; time_s < 4; time_s += 0.1)
    EXPECT_LT(largestShift(at({}, time_s), at({}, time_s + 0.01)), 0.25);
}

TEST_F(Deformation, RigidPushesStayAndAddUp) {
  DeformationOptions pushed = still();
  pushed.push = {2.5, 0.1};
  pushed.push_kind = "arap";
  TissueDeformation tissue(organ_, kFocus_mm, pushed, 7);
  const auto first = tissue.verticesAt(0.1), second = tissue.verticesAt(0.2);
  // A push is 2 to 3 mm where the tip holds; the elastic bed takes a tenth of it at most.
  for (const float moved_mm :
       {largestShift(first, organ_.vertices_mm), largestShift(second, first)}) {
    EXPECT_GE(moved_mm, 1.8F);
    EXPECT_LE(moved_mm, 3.0F);
  }
  EXPECT_EQ(tissue.verticesAt(0.1), first) << "any frame can be asked for again";
  EXPECT_EQ(at(pushed, 0.2), second);
}

TEST_F(Deformation, RigidPushesKeepLengthsAndLeaveWhatIsFarAway) {
  DeformationOptions pushed = still();
  pushed.push = {2.5, 0.1};
  pushed.push_kind = "arap";
  const auto moved = at(pushed, 0.1);
  double strain = 0, edges = 0;
  for (const Triangle& t : organ_.triangles) {
    const float rest = (organ_.vertices_mm[t[1]] - organ_.vertices_mm[t[0]]).norm();
    const float change = std::abs((moved[t[1]] - moved[t[0]]).norm() / rest - 1);
    EXPECT_LT(change, 0.5);
    strain += change;
    ++edges;
  }
  EXPECT_LT(strain / edges, 0.01) << "lengths stay";
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Eigen::Vector3f& rest = organ_.vertices_mm[i];  // 2.2 spreads to the site, 4 beyond it
    EXPECT_TRUE((rest - kFocus_mm).norm() < 55 || (moved[i] - rest).norm() < 0.1F);
  }
}

TEST_F(Deformation, RefusesWhatWouldFoldTheSurface) {
  DeformationOptions options;
  options.push_spread_mm = 2;
  EXPECT_THROW(at(options, 0), OptionError);
  options = {};
  options.breathing.period_s = 0;
  EXPECT_THROW(at(options, 0), OptionError);
  options = {};
  options.heartbeat.amplitude_mm = -1;
  EXPECT_THROW(at(options, 0), OptionError);
}

}  // namespace
}  // namespace softscope
