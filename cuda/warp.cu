#include "cuda/device_machine.cuh"
#include "cuda/warp.h"
#include "cuda/warp_run.h"

namespace softscope::cuda {

std::unique_ptr<WarpDevice> makeWarpDevice(const WarpWeights& weights) {
  requireDevice();
  return std::make_unique<WarpRun<DeviceMachine>>(weights);
}

}  // namespace softscope::cuda
