// tests/deform/test_warp.cpp: points and normals follow their nodes.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "deform/graph/warp.h"
#include "deform/kernels/node_terms.h"
#include "scenes.h"

namespace softscope {
namespace {

void waveNodes(WarpGraph* graph) {
  for (std::size_t j = 0; j < graph->size(); ++j) {
    const double s = static_cast<double>(j);
    graph->transforms[j].linear =
        rotationOf({0.1 * std::sin(s), 0.1 * std::cos(2 * s), 0.05}).toRotationMatrix();
    graph->transforms[j].translation_mm = {std::cos(s), 0.5, std::sin(3 * s)};
  }
}

TEST(Warp, ARigidMotionOfAllNodesMovesEveryPointAndNormalSo) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  const PointModel before = model;
  WarpGraph graph = scenes::bindGraph(&model);
  const Eigen::Isometry3d motion = scenes::rigidMotion();
  scenes::moveNodes(motion, &graph);

  warpModel(graph, &model);

  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d truth = motion * before.positions_mm[i].cast<double>();
    EXPECT_LT((model.positions_mm[i].cast<double>() - truth).norm(), 2e-5);  // floats of 60 mm
    const Eigen::Vector3d normal = motion.linear() * before.normals[i].cast<double>();
    EXPECT_LT((model.normals[i].cast<double>() - normal).norm(), 1e-5);
  }
}

TEST(Warp, AgreesWithTheExactTwin) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  const PointModel before = model;
  WarpGraph graph = scenes::bindGraph(&model);
  waveNodes(&graph);
  warpModel(graph, &model);
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d truth =
        warpPoint(graph, model.bindings[i], before.positions_mm[i].cast<double>());
    EXPECT_LT((model.positions_mm[i].cast<double>() - truth).norm(), 2e-5);
  }
}

TEST(Warp, NormalsStayAcrossASlantedAndStretchedSurface) {
  PointModel model;
  model.add({1, 0, 0}, Eigen::Vector3f(1, 0, 1).normalized(), {}, 1);  // across (1, 0, -1)
  model.bindings[0] = {0, {1, 0, 0, 0}};
  WarpGraph graph;
  graph.positions_mm = {{0, 0, 0}};
  graph.transforms.resize(1);
  graph.transforms[0].linear = Eigen::Vector3d(3, 1, 1).asDiagonal();
  graph.stencils = {{0, 0, 0, 0}};
  warpModel(graph, &model);
  const Eigen::Vector3f tangent(3, 0, -1);
  EXPECT_NEAR(model.normals[0].dot(tangent), 0, 1e-6);
  EXPECT_NEAR(model.normals[0].norm(), 1, 1e-6);
}

TEST(Warp, TheIdentityChangesNotOneByteHoweverOften) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  const PointModel before = model;
  WarpGraph graph = scenes::bindGraph(&model);
  for (int frame = 0; frame < 100; ++frame) {
    warpModel(graph, &model);
    rebase(&graph);
  }
  EXPECT_EQ(model.positions_mm, before.positions_mm);  // weights of 1 + 1e-7 must not add up
}

TEST(Warp, IsTheSameOnAnyNumberOfThreadsAndUpToRoundingOnAnySet) {
  PointModel model = scenes::makeHill(40, 40, 0.4);
  WarpGraph graph = scenes::bindGraph(&model);
  waveNodes(&graph);
  std::vector<PointModel> warped;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    warped.push_back(model);
    warpModel(graph, &warped.back());
  }
  EXPECT_EQ(warped[0].positions_mm, warped[1].positions_mm);
  EXPECT_EQ(warped[0].normals, warped[1].normals);

  const auto list = allDeformKernels();
  const auto nodes = packNodes(graph);
  for (int set = 0; set < list.count; ++set) {
    PointModel other = model;
    list.sets[set]->warpPoints(nodes.data(), graph.stencils.front().data(), other.bindings.data(),
                               sizeof(PointBinding), other.positions_mm.front().data(),
                               other.normals.front().data(), static_cast<int>(other.size()),
                               other.positions_mm.front().data(), other.normals.front().data());
    for (std::size_t i = 0; i < other.size(); ++i)
      EXPECT_LT((other.positions_mm[i] - warped[0].positions_mm[i]).norm(), 2e-5f)
          << list.sets[set]->instruction_set;
  }
}

TEST(Warp, UnboundPointsStayAndCollapsedNodesKeepNormals) {
  PointModel model;
  model.add({1, 2, 3}, {0, 0, 1}, {}, 1);
  model.add({1, 2, 3}, {0, 0, 1}, {}, 1);
  model.bindings[1] = {0, {1, 0, 0, 0}};
  WarpGraph graph;
  graph.positions_mm = {{0, 0, 0}};
  graph.transforms.resize(1);
  graph.transforms[0].linear.setZero();
  graph.stencils = {{0, 0, 0, 0}};
  warpModel(graph, &model);
  EXPECT_EQ(model.positions_mm[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(model.normals[1], Eigen::Vector3f(0, 0, 1));
}

TEST(Rebase, MovesNodesAndForgetsTransforms) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const Eigen::Vector3d at = graph.positions_mm[3];
  waveNodes(&graph);
  const Eigen::Vector3d by = graph.transforms[3].translation_mm;
  rebase(&graph);
  EXPECT_EQ(graph.positions_mm[3], at + by);
  EXPECT_TRUE(graph.transforms[3].linear.isIdentity(0));
  EXPECT_TRUE(graph.transforms[3].translation_mm.isZero(0));
}

// Turns count like shifts: half a spacing from its nodes, a point moves by both alike.
TEST(ReferencePosition, IsWhereThePointWasBeforeAllMotionsOfItsNodes) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  const PointModel before = model;
  WarpGraph graph = scenes::bindGraph(&model);
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = rotationOf({0.1, -0.2, 0.3}).toRotationMatrix();
  for (const Eigen::Isometry3d& motion : {scenes::rigidMotion(), turn}) {
    scenes::moveNodes(motion, &graph);
    warpModel(graph, &model);
    rebase(&graph);
  }
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d now = model.positions_mm[i].cast<double>();
    const Eigen::Vector3d then = before.positions_mm[i].cast<double>();
    EXPECT_LT((referencePosition(graph, model.bindings[i], now) - then).norm(), 5e-5);  // floats
  }
}

// Turns of nodes at random leave no drift, to the second order in the angle.
TEST(ReferencePosition, IsWhereThePointWasBeforeManySmallUnevenMotions) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  const PointModel before = model;
  WarpGraph graph = scenes::bindGraph(&model);
  for (int k = 0; k < 20; ++k) {
    waveNodes(&graph);
    for (NodeTransform& transform : graph.transforms) {
      const Eigen::AngleAxisd whole(transform.linear);
      transform.linear = Eigen::AngleAxisd(0.01 * whole.angle(), whole.axis()).matrix();
      transform.translation_mm *= 0.001;
    }
    warpModel(graph, &model);
    rebase(&graph);
  }
  double moved_mm = 0, error_mm = 0;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d now = model.positions_mm[i].cast<double>();
    const Eigen::Vector3d then = before.positions_mm[i].cast<double>();
    moved_mm = std::max(moved_mm, (now - then).norm());
    error_mm = std::max(error_mm, (referencePosition(graph, model.bindings[i], now) - then).norm());
  }
  EXPECT_GT(moved_mm, 0.05);
  EXPECT_LT(error_mm, 0.02 * moved_mm);
}

TEST(ReferencePosition, OfAnUnboundPointIsThePoint) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  const WarpGraph graph = scenes::bindGraph(&model);
  EXPECT_EQ(referencePosition(graph, PointBinding(), {1, 2, 3}), Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace softscope
