#include "cuda/comparison/comparison.h"
#include "cuda/comparison/comparison_run.h"
#include "cuda/device/device_machine.cuh"
#include "cuda/model/shared_model.cuh"

namespace softscope::cuda {

std::unique_ptr<FrameComparer> makeFrameComparer(const PinholeCamera& left,
                                                 std::shared_ptr<const SharedRasters> shared,
                                                 std::shared_ptr<SharedModel> model) {
  requireDevice();
  auto run = std::make_unique<ComparisonRun<DeviceMachine>>(left);
  run->share(std::move(shared));
  run->share(std::move(model));
  return run;
}

}  // namespace softscope::cuda
