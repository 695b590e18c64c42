#include "io/sequences/tissue_masks.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "core/error.h"
#include "io/files/folder.h"
#include "io/images/image_reader.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool isLeftMask(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.size() > 1 && stem.back() == 'l' &&
         std::all_of(stem.begin(), stem.end() - 1, [](unsigned char c) { return std::isdigit(c); });
}

}  // namespace

TissueMasks findTissueMasks(const fs::path& folder, int frames) {
  std::map<long long, fs::path> by_number;
  for (const fs::path& file : filesIn(folder, {".png"})) {
    const auto number = frameNumber(file);
    if (!isLeftMask(file) || !number) continue;
    if (!by_number.emplace(*number, file).second)
      throw InputError(
          say(shown(file), ": is a second mask of frame ", *number, ". Download it again."));
  }
  if (by_number.empty())
    throw InputError(shown(folder) +
                     ": holds no mask NNNNNNl.png, but StereoMIS has them. Download it again, or "
                     "remove the folder to use the images without masks.");
  TissueMasks masks;
  int without = 0;
  for (long long frame = 0; frame < frames; ++frame) {
    auto mask = by_number.find(frame);
    if (mask == by_number.end()) mask = by_number.find(frame - 1);
    masks.files.push_back(mask == by_number.end() ? fs::path() : mask->second);
    without += masks.files.back().empty();
  }
  if (without > 0)
    masks.warnings.push_back(say(shown(folder), ": ", without, " of ", frames,
                                 " frames have no mask; instruments are not masked there."));
  const auto beyond = std::distance(by_number.lower_bound(frames), by_number.end());
  if (beyond > 0)
    masks.warnings.push_back(say(shown(folder), ": ", beyond, " masks are of frames after the last",
                                 ", ", frames - 1, ". Are they of this video?"));
  return masks;
}

Mask readTissueMask(const fs::path& file, int width_px, int height_px) {
  const Mask tissue = readMask(file);
  Mask ignored(width_px, height_px);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u)
      ignored.at(u, v) = tissue.at((2 * u + 1) * tissue.width_px / (2 * width_px),
                                   (2 * v + 1) * tissue.height_px / (2 * height_px)) == 0
                             ? 255
                             : 0;
  return ignored;
}

}  // namespace softscope
