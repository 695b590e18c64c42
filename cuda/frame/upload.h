// cuda/frame/upload.h: frames copied to the first GPU ahead of the stages.
#pragma once

#include <memory>

#include "core/camera.h"
#include "cuda/device/shared_rasters.h"
#include "fusion/frame_uploader.h"

namespace softscope::cuda {

/// Tells the stages by `shared`. Throws BackendError where no GPU works.
std::unique_ptr<FrameUploader> makeFrameUploader(const PinholeCamera& left,
                                                 std::shared_ptr<SharedRasters> shared);

}  // namespace softscope::cuda
