// tests/cuda/fusion_device.h: the kernels of fusion_kernels.h on the first GPU.
#pragma once

#include "fusion_run.h"

namespace softscope::test {

/// Throws BackendError where no GPU works.
FusionResult fuseOnDevice(const FusionInputs& from);

}  // namespace softscope::test
