#include "cuda/comparison/comparison.h"
#include "cuda/comparison/comparison_run.h"
#include "cuda/device/device_machine.cuh"

namespace softscope::cuda {

std::unique_ptr<FrameComparer> makeFrameComparer(const PinholeCamera& left,
                                                 std::shared_ptr<SharedRasters> shared) {
  requireDevice();
  auto run = std::make_unique<ComparisonRun<DeviceMachine>>(left);
  run->share(std::move(shared));
  return run;
}

}  // namespace softscope::cuda
