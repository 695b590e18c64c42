#include "cuda/device/device_machine.cuh"
#include "cuda/warp/warp.h"
#include "cuda/warp/warp_run.h"

namespace softscope::cuda {

std::unique_ptr<WarpDevice> makeWarpDevice(const WarpWeights& weights,
                                           std::shared_ptr<const SharedRasters> shared) {
  requireDevice();
  auto run = std::make_unique<WarpRun<DeviceMachine>>(weights);
  run->share(std::move(shared));
  return run;
}

}  // namespace softscope::cuda
