// tests/cuda/model_warp_cases.h: a model whose warp on a device must be that of the CPU.
#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "deform/graph/model_warp.h"
#include "tests/deform/scenes.h"

namespace softscope::test {

/// A hill of bound points, and one that nothing carries; every node turns and moves.
struct ModelWarpScene {
  PointModel model = scenes::makeHill(40, 30, 0.25);
  WarpGraph graph;

  ModelWarpScene() {
    model.add({300, 0, 60}, {0, 0, -1}, {90, 90, 90}, 1);
    graph = scenes::bindGraph(&model, 4);
    model.bindings.back() = PointBinding();
    for (std::size_t j = 0; j < graph.size(); ++j) {
      const double angle = 0.02 * static_cast<double>(j % 7);
      graph.transforms[j].linear =
          Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
      graph.transforms[j].translation_mm = {0.3 * std::sin(double(j)), 0.1, -0.2};
    }
  }
  PointModel expected() const {
    PointModel warped = model;
    EXPECT_TRUE(CpuModelWarp().apply(graph, &warped));
    return warped;
  }
};

/// Equal bytes.
inline void expectSameShape(const std::vector<Eigen::Vector3f>& positions_mm,
                            const std::vector<Eigen::Vector3f>& normals,
                            const PointModel& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(positions_mm[i], expected.positions_mm[i]) << i;
    ASSERT_EQ(normals[i], expected.normals[i]) << i;
  }
}

}  // namespace softscope::test
