// toolkit/study/study_gpus.h: distribution of the cases of a study over the GPUs of a host.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "toolkit/study/study_file.h"

namespace softscope {

/// True if any case may reconstruct on a GPU: its back end is cuda or auto.
bool mayUseGpus(const Study& study);

/// GPUs available to this process, by their names in CUDA_VISIBLE_DEVICES: its entries if it is
/// set, otherwise "0", "1", …. Empty without a usable GPU. Takes up to a second, for the driver.
std::vector<std::string> visibleGpus();

/// The part of visibleGpus() without the driver. `variable`:
/// the value of CUDA_VISIBLE_DEVICES, null if not set.
std::vector<std::string> gpuNames(const char* variable, std::size_t device_count);

/// GPUs, each with the number of processes that run on it.
class GpuPool {
 public:
  explicit GpuPool(std::vector<std::string> names)
      : names_(std::move(names)), used_(names_.size()) {}
  bool empty() const { return names_.empty(); }
  /// Reserves the GPU with the fewest processes, the
  /// first of several. Requires a non-empty pool.
  std::size_t take();
  void giveBack(std::size_t gpu) { --used_[gpu]; }
  const std::string& name(std::size_t gpu) const { return names_[gpu]; }

 private:
  std::vector<std::string> names_;
  std::vector<int> used_;
};

}  // namespace softscope
