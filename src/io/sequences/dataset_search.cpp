#include "io/sequences/dataset_search.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "io/sequences/dataset_form.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 3;  // 0: direct subfolders
constexpr int kMostFolders = 2000;

std::optional<DatasetClip> recogniseWhole(const fs::path& folder) {
  try {
    return recogniseDataset(folder);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<FoundClip> clipsBelow(const fs::path& folder) {
  std::vector<FoundClip> found;
  std::error_code code;
  fs::recursive_directory_iterator place(folder, fs::directory_options::skip_permission_denied,
                                         code);
  int folders = 0;
  for (; !code && place != fs::recursive_directory_iterator(); place.increment(code)) {
    std::error_code ignored;
    if (!place->is_directory(ignored) || place->is_symlink(ignored)) continue;
    if (++folders > kMostFolders) break;
    if (place.depth() >= kDeepest) place.disable_recursion_pending();
    if (const auto clip = recogniseWhole(place->path())) {
      found.push_back({place->path(), clip->form});
      place.disable_recursion_pending();
    }
  }
  std::sort(found.begin(), found.end(),
            [](const FoundClip& a, const FoundClip& b) { return a.folder < b.folder; });
  return found;
}

}  // namespace softscope
