#include "cuda/device/device_machine.cuh"
#include "cuda/pose/pose.h"
#include "cuda/pose/pose_run.h"

namespace softscope::cuda {

std::unique_ptr<PoseSearch> makePoseSearch() {
  requireDevice();
  return std::make_unique<PoseRun<DeviceMachine>>();
}

}  // namespace softscope::cuda
