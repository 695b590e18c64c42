#include "cuda/device/device_machine.cuh"
#include "cuda/frame/survey.h"
#include "cuda/frame/survey_run.h"

namespace softscope::cuda {

std::unique_ptr<FrameSurvey> makeFrameSurvey(const PinholeCamera& left,
                                             std::shared_ptr<const SharedRasters> measured,
                                             std::shared_ptr<SharedRasters> shared) {
  requireDevice();
  return std::make_unique<SurveyRun<DeviceMachine>>(left, std::move(measured), std::move(shared));
}

}  // namespace softscope::cuda
