// cuda/model/shared_model.h: the model on the first GPU, handed to the stages that work on it.
#pragma once

#include <memory>

namespace softscope::cuda {

/// A ModelHome on the device; host code passes it on.
class SharedModel;

/// Takes memory when the first stage needs it.
std::shared_ptr<SharedModel> makeSharedModel();

}  // namespace softscope::cuda
