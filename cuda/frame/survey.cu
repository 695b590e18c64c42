#include "cuda/device/device_machine.cuh"
#include "cuda/frame/survey.h"
#include "cuda/frame/survey_run.h"

namespace softscope::cuda {

std::unique_ptr<FrameSurvey> makeFrameSurvey(const PinholeCamera& left,
                                             std::shared_ptr<SharedFrames> frames) {
  requireDevice();
  return std::make_unique<SurveyRun<DeviceMachine>>(left, std::move(frames));
}

}  // namespace softscope::cuda
