#include "cuda/model/shared_model.cuh"
#include "cuda/warp/model_warp.h"
#include "cuda/warp/model_warp_run.h"

namespace softscope::cuda {

std::unique_ptr<ModelWarp> makeModelWarp(std::shared_ptr<SharedModel> model) {
  requireDevice();
  return std::make_unique<ModelWarpRun<DeviceMachine>>(std::move(model));
}

}  // namespace softscope::cuda
