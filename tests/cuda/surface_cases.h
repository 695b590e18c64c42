// tests/cuda/surface_cases.h: positions on and off a model, whose surface kernels must find as the
// CPU does.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "fusion/surface_search.h"

namespace softscope::test {

/// A wavy sheet of 60 x 60 mm in several thousand points, in any order, far from the origin; one
/// spot is crowded, and a few points have no finite position.
struct SurfaceScene {
  PointModel model;
  std::vector<Eigen::Vector3d> positions_mm;

  explicit SurfaceScene(int crowd = 300) {
    std::mt19937 random(7);
    const auto next = [&] { return static_cast<float>(random()) / 4294967296.0f; };
    const Eigen::Vector3f far_mm(130, -80, 210);
    for (int i = 0; i < 20000; ++i) {
      const float x = 60 * next(), y = 60 * next(), z = std::sin(0.3f * x) + 0.1f * next();
      const Eigen::Vector3f normal = Eigen::Vector3f(0.2f * next(), 0.1f, -1).normalized();
      model.add(far_mm + Eigen::Vector3f(x, y, z), normal, Rgb8{}, 0.5f + next());
    }
    const Eigen::Vector3f spot_mm = model.positions_mm[100];
    for (int i = 0; i < crowd; ++i)
      model.add(spot_mm + 0.3f * Eigen::Vector3f(next(), next(), next()), Eigen::Vector3f::UnitZ(),
                Rgb8{}, next());
    model.add(spot_mm * std::numeric_limits<float>::quiet_NaN(), Eigen::Vector3f::UnitZ(), Rgb8{},
              1);
    model.add(model.positions_mm[200], model.normals[200], Rgb8{}, 1);  // as near as another
    for (int k = 0; k < 300; ++k)
      positions_mm.push_back(model.positions_mm[static_cast<std::size_t>(61 * k)].cast<double>() +
                             0.4 * Eigen::Vector3d(next(), next(), next()));
    positions_mm.push_back(spot_mm.cast<double>());
    positions_mm.push_back(model.positions_mm[200].cast<double>());
    positions_mm.emplace_back(0, 0, 0);  // no point around it
  }
  std::vector<Eigen::Vector3f> targets() const {
    std::vector<Eigen::Vector3f> targets_mm;
    for (const Eigen::Vector3d& position : positions_mm)
      targets_mm.push_back(position.cast<float>());
    return targets_mm;
  }
};

/// Everything, as bytes.
inline void expectSameSurface(const SurfaceScene& scene, SurfaceSearch* search) {
  CpuSurfaceSearch cpu;
  EXPECT_EQ(search->nearestPoints(scene.model, scene.targets()),
            cpu.nearestPoints(scene.model, scene.targets()));
  const std::vector<SurfacePiece> found = search->piecesAround(scene.model, scene.positions_mm),
                                  expected = cpu.piecesAround(scene.model, scene.positions_mm);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_EQ(std::memcmp(&found[k], &expected[k], sizeof(SurfacePiece)), 0) << k;
}

}  // namespace softscope::test
