#include "cuda/model/shared_model.cuh"
#include "cuda/surface/surface.h"
#include "cuda/surface/surface_run.h"

namespace softscope::cuda {

std::unique_ptr<SurfaceSearch> makeSurfaceSearch(std::shared_ptr<SharedModel> model) {
  requireDevice();
  auto run = std::make_unique<SurfaceRun<DeviceMachine>>();
  if (model) run->share(std::move(model));
  return run;
}

}  // namespace softscope::cuda
