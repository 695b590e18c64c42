#include "cuda/device/device_machine.cuh"
#include "fusion_device.h"

namespace softscope::test {

FusionResult fuseOnDevice(const FusionInputs& from) {
  cuda::requireDevice();
  return FusionRun<cuda::DeviceMachine>().update(from);
}

}  // namespace softscope::test
