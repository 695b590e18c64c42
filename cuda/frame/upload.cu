#include "cuda/device/device_machine.cuh"
#include "cuda/frame/upload.h"
#include "cuda/frame/upload_run.h"

namespace softscope::cuda {

std::unique_ptr<FrameUploader> makeFrameUploader(const PinholeCamera& left,
                                                 std::shared_ptr<SharedRasters> shared) {
  requireDevice();
  return std::make_unique<UploadRun<DeviceMachine>>(left, std::move(shared));
}

}  // namespace softscope::cuda
