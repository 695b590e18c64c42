#include "cuda/comparison.h"
#include "cuda/comparison_run.h"
#include "cuda/device_machine.cuh"

namespace softscope::cuda {

std::unique_ptr<FrameComparer> makeFrameComparer(const PinholeCamera& left) {
  requireDevice();
  return std::make_unique<ComparisonRun<DeviceMachine>>(left);
}

}  // namespace softscope::cuda
