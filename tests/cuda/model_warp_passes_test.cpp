// tests/cuda/model_warp_passes_test.cpp: the kernel that warps the model, run on the host in
// shuffled orders, carries its points as the CPU does.
#include <gtest/gtest.h>

#include "core/error.h"
#include "cuda/warp/model_warp_run.h"
#include "host_machine.h"
#include "model_warp_cases.h"

namespace softscope::test {
namespace {

class ModelWarpPasses : public testing::Test {
 protected:
  /// The model on the "device".
  void expectThere(const PointModel& expected) {
    HostMachine machine(1);
    const cuda::ModelArrays& at = home_->bring(scene_.model, kModelShape, 0, machine);
    const std::size_t count = expected.size();
    expectSameShape({at.positions_mm, at.positions_mm + count}, {at.normals, at.normals + count},
                    expected);
  }

  const ModelWarpScene scene_;
  std::shared_ptr<cuda::ModelHome<HostMachine>> home_ =
      std::make_shared<cuda::ModelHome<HostMachine>>();
};

TEST_F(ModelWarpPasses, CarryPointsAsTheCpuDoesInAnyOrderOfThreads) {
  for (const unsigned seed : {1U, 77U}) {
    home_->changed(kWholeModel);
    PointModel model = scene_.model;
    EXPECT_FALSE(cuda::ModelWarpRun<HostMachine>(home_, seed).apply(scene_.graph, &model));
    EXPECT_EQ(model.positions_mm, scene_.model.positions_mm);
    expectThere(scene_.expected());
  }
}

TEST_F(ModelWarpPasses, EndWhereTheHostsPointsAreIfUndone) {
  PointModel model = scene_.model;
  cuda::ModelWarpRun<HostMachine> warp(home_, 3U);
  warp.apply(scene_.graph, &model);
  warp.undo(&model);
  expectThere(scene_.model);
}

TEST_F(ModelWarpPasses, MakeWhatIsKnownOfTheFrameOutOfDate) {
  PointModel model = scene_.model;
  const std::vector<std::uint8_t> seen(model.size(), 1);
  home_->setSeen(seen.data());
  cuda::ModelWarpRun<HostMachine>(home_, 3U).apply(scene_.graph, &model);
  EXPECT_EQ(home_->seen(), nullptr);
}

/// Fails with every wait.
class BrokenMachine : public HostMachine {
 public:
  using HostMachine::HostMachine;
  void wait() const { throw BackendError("broken"); }
};

TEST(ModelWarpOnABrokenDevice, LeavesTheHostsModelInForce) {
  const ModelWarpScene scene;
  PointModel model = scene.model;
  const auto home = std::make_shared<cuda::ModelHome<BrokenMachine>>();
  // Room first, for which the model waits as well.
  EXPECT_THROW(cuda::ModelWarpRun<BrokenMachine>(home, 3U).apply(scene.graph, &model),
               BackendError);
  EXPECT_EQ(model.positions_mm, scene.model.positions_mm);
}

}  // namespace
}  // namespace softscope::test
