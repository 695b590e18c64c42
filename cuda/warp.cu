#include "cuda/device_machine.cuh"
#include "cuda/warp.h"
#include "cuda/warp_run.h"

namespace softscope::cuda {

std::unique_ptr<WarpDevice> makeWarpDevice(const WarpWeights& weights,
                                           std::shared_ptr<const SharedRasters> shared) {
  requireDevice();
  auto run = std::make_unique<WarpRun<DeviceMachine>>(weights);
  run->share(std::move(shared));
  return run;
}

}  // namespace softscope::cuda
