#include "pipeline/backends.h"

namespace softscope {

// The only file that asks whether CUDA was built.
cuda::DeviceInfo cudaDevices() {
#ifdef SOFTSCOPE_HAS_CUDA
  return cuda::queryDevices();
#else
  cuda::DeviceInfo info;
  info.why_none =
      "this build has no CUDA: with a CUDA 12 or 13 toolkit installed, configure by "
      "`cmake --preset cuda`";
  return info;
#endif
}

}  // namespace softscope
