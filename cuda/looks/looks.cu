#include "cuda/device/device_machine.cuh"
#include "cuda/looks/looks.h"
#include "cuda/looks/looks_run.h"

namespace softscope::cuda {

std::unique_ptr<LookFinder> makeLookFinder() {
  requireDevice();
  return std::make_unique<LooksRun<DeviceMachine>>();
}

}  // namespace softscope::cuda
