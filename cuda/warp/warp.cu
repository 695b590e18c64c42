#include "cuda/device/device_machine.cuh"
#include "cuda/model/shared_model.cuh"
#include "cuda/warp/warp.h"
#include "cuda/warp/warp_run.h"

namespace softscope::cuda {

std::unique_ptr<WarpDevice> makeWarpDevice(const WarpWeights& weights,
                                           std::shared_ptr<const SharedRasters> shared,
                                           std::shared_ptr<SharedModel> model) {
  requireDevice();
  auto run = std::make_unique<WarpRun<DeviceMachine>>(weights);
  run->share(std::move(shared));
  run->share(std::move(model));
  return run;
}

}  // namespace softscope::cuda
