#include "toolkit/study/study_gpus.h"

#include <algorithm>
#include <cstdlib>

#include "pipeline/backends.h"

namespace softscope {

bool mayUseGpus(const Study& study) {
  return std::any_of(study.cases.begin(), study.cases.end(), [](const StudyCase& one) {
    const auto backend = one.reconstruct.find("backend");
    return backend == one.reconstruct.end() || backend->second != "cpu";
  });
}

std::vector<std::string> gpuNames(const char* variable, std::size_t device_count) {
  std::vector<std::string> names;
  const std::string list = variable != nullptr ? variable : "";
  for (std::size_t at = 0; at < list.size() && names.size() < device_count;) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    names.push_back(list.substr(at, end - at));
    at = end + 1;
  }
  // CUDA ignores the entries from the first invalid one on: `device_count` counts those before it.
  for (std::size_t index = 0; variable == nullptr && index < device_count; ++index)
    names.push_back(std::to_string(index));
  return names;
}

std::vector<std::string> visibleGpus() {
  const cuda::DeviceInfo info = cudaDevices();
  const bool usable = !info.devices.empty() && info.devices.front().problem.empty();
  return gpuNames(std::getenv("CUDA_VISIBLE_DEVICES"), usable ? info.devices.size() : 0);
}

std::size_t GpuPool::take() {
  const std::size_t gpu = static_cast<std::size_t>(
      std::distance(used_.begin(), std::min_element(used_.begin(), used_.end())));
  ++used_[gpu];
  return gpu;
}

}  // namespace softscope
