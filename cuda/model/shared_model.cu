#include "cuda/model/shared_model.cuh"

namespace softscope::cuda {

std::shared_ptr<SharedModel> makeSharedModel() { return std::make_shared<SharedModel>(); }

}  // namespace softscope::cuda
