// cuda/model/shared_model.cuh: what a SharedModel is.
#pragma once

#include "cuda/device/device_machine.cuh"
#include "cuda/model/model_home.h"
#include "cuda/model/shared_model.h"

namespace softscope::cuda {

class SharedModel : public ModelHome<DeviceMachine> {};

}  // namespace softscope::cuda
