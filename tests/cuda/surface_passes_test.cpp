// tests/cuda/surface_passes_test.cpp: the kernels that search the model's surface, run on the host
// in shuffled orders, find what the CPU does.
#include <gtest/gtest.h>

#include <memory>

#include "cuda/surface/surface_run.h"
#include "host_machine.h"
#include "surface_cases.h"

namespace softscope::test {
namespace {

TEST(SurfacePasses, FindTheSurfaceAsTheCpuDoesInAnyOrderOfThreads) {
  const SurfaceScene scene;
  CpuSurfaceSearch cpu;
  const std::vector<SurfacePiece> pieces = cpu.piecesAround(scene.model, scene.positions_mm);
  EXPECT_GT(pieces[pieces.size() - 3].weight, 50);  // the crowd
  EXPECT_EQ(pieces.back().weight, 0);
  EXPECT_EQ(cpu.nearestPoints(scene.model, scene.targets())[301], 200);  // of two the first
  for (const unsigned seed : {1U, 77U}) {
    cuda::SurfaceRun<HostMachine> kernels(seed);
    expectSameSurface(scene, &kernels);
    expectSameSurface(scene, &kernels);  // nothing is left of another frame
  }
}

/// More points than a list has room for: the CPU adds them up.
TEST(SurfacePasses, LeaveACrowdToTheCpu) {
  const SurfaceScene scene(2 * cuda::kMostOfPiece);
  cuda::SurfaceRun<HostMachine> kernels(3U);
  expectSameSurface(scene, &kernels);
}

TEST(SurfacePasses, FindTheModelWhereAnotherStageLeftIt) {
  const SurfaceScene scene;
  const auto home = std::make_shared<cuda::ModelHome<HostMachine>>();
  cuda::SurfaceRun<HostMachine> kernels(5U);
  kernels.share(home);
  expectSameSurface(scene, &kernels);
  SurfaceScene moved = scene;
  for (Eigen::Vector3f& point : moved.model.positions_mm) point.z() += 0.05f;
  home->changed(kModelShape);
  expectSameSurface(moved, &kernels);
}

TEST(SurfacePasses, FindNothingInAnEmptyModel) {
  cuda::SurfaceRun<HostMachine> kernels(3U);
  EXPECT_EQ(kernels.nearestPoints(PointModel(), {Eigen::Vector3f::Zero()}),
            std::vector<std::int32_t>{-1});
  EXPECT_EQ(kernels.piecesAround(PointModel(), {Eigen::Vector3d::Zero()}).front().weight, 0);
}

}  // namespace
}  // namespace softscope::test
