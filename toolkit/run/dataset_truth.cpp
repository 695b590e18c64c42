#include "toolkit/run/dataset_truth.h"

namespace softscope {

std::string describeTruth(const DatasetClip& clip) {
  std::string names;
  for (const std::filesystem::path& file : clip.truth)
    names += (names.empty() ? "" : ", ") + file.filename().string();
  if (names.empty()) return names;
  return names + (clip.benchmark.empty() ? ": not read by softscope"
                                         : ": read by `softscope benchmark " + clip.benchmark +
                                               "`, not by `evaluate`");
}

}  // namespace softscope
