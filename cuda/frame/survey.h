// cuda/frame/survey.h: frames surveyed by the first GPU ahead of the stages.
#pragma once

#include <memory>

#include "core/camera.h"
#include "cuda/device/shared_rasters.h"
#include "fusion/frame_survey.h"

namespace softscope::cuda {

/// Leaves the next frame and the one at hand in `frames`. Depth that is measured there is not
/// copied from the host. Throws BackendError where no GPU works.
std::unique_ptr<FrameSurvey> makeFrameSurvey(const PinholeCamera& left,
                                             std::shared_ptr<SharedFrames> frames);

}  // namespace softscope::cuda
