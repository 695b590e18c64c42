#include "cuda/fusion/fusion.h"
#include "cuda/fusion/fusion_run.h"
#include "cuda/model/shared_model.cuh"

namespace softscope::cuda {

std::unique_ptr<ModelUpdater> makeModelUpdater(const PinholeCamera& left,
                                               std::shared_ptr<const SharedRasters> shared,
                                               std::shared_ptr<SharedModel> model) {
  requireDevice();
  auto run = std::make_unique<FusionRun<DeviceMachine>>(left);
  run->share(std::move(shared));
  if (model) run->share(std::move(model));
  return run;
}

}  // namespace softscope::cuda
