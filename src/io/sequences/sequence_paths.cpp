#include "io/sequences/sequence_paths.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"
#include "io/files/folder.h"
#include "io/sequences/dataset_form.h"
#include "io/sequences/picture_source.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> kVideoKinds = {".mp4",  ".avi", ".mkv",  ".mov", ".m4v",
                                                          ".webm", ".mpg", ".mpeg", ".wmv", ".ts"};

template <class Kinds>
bool isOneOf(const fs::path& file, const Kinds& kinds) {
  return std::find(kinds.begin(), kinds.end(), lowerCase(file.extension().string())) != kinds.end();
}

/// True also for a dangling symbolic link: the opening reports it.
bool hasEntry(const fs::path& path) {
  std::error_code code;
  return fs::exists(fs::symlink_status(path, code));
}

fs::path ifThere(const fs::path& path) { return hasEntry(path) ? path : fs::path(); }

/// folder/name.mp4, .avi, …; empty if absent.
fs::path videoNamed(const fs::path& folder, const std::string& name) {
  for (const std::string_view kind : kVideoKinds)
    if (const fs::path file = folder / (name + std::string(kind)); hasEntry(file)) return file;
  return {};
}

/// Folder of images, else a video.
fs::path viewNamed(const fs::path& folder, const std::string& name) {
  return hasEntry(folder / name) ? folder / name : videoNamed(folder, name);
}

/// First entries of the folder by name, and what to do about them.
std::string foundIn(const fs::path& folder) {
  constexpr std::size_t kMostNames = 6;
  const std::size_t images = filesIn(folder, {kPictureKinds.begin(), kPictureKinds.end()}).size();
  if (images > 0)
    return say(" Found there: ", images, " images. A folder of images is one view: give left and ",
               "right folders. Two views in each image are read from one image or one video.");
  std::vector<std::string> names;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (name.front() != '.') names.push_back(name + (entry.is_directory(code) ? "/" : ""));
  }
  if (names.empty()) return " The folder is empty.";
  std::sort(names.begin(), names.end());
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
    list += (i == 0 ? "" : ", ") + names[i];
  return say(" Found there: ", shown(list), names.size() > kMostNames ? ", …" : "",
             ". Rename the views, or give both and the calibration separately.");
}

}  // namespace

bool isVideo(const fs::path& file) { return isOneOf(file, kVideoKinds); }
bool isPicture(const fs::path& file) { return isOneOf(file, kPictureKinds); }

SequencePaths findSequence(const fs::path& folder) {
  requireFolder(folder);
  SequencePaths paths;
  paths.calibration = folder;
  paths.mask = ifThere(folder / "mask");
  paths.depth = ifThere(folder / "depth");
  paths.timestamps = ifThere(folder / "timestamps.txt");
  paths.left = viewNamed(folder, "left");
  paths.right = viewNamed(folder, "right");
  if (paths.left.empty() && paths.right.empty()) paths.stereo = videoNamed(folder, "stereo");
  const bool is_own = !paths.left.empty() || !paths.stereo.empty();
  if (!is_own || isFile(folder / "calib.json")) {  // name in STIR; its videos may have our names
    if (const auto clip = recogniseDataset(folder)) {
      SequencePaths shipped = clip->paths;
      if (!paths.mask.empty()) shipped.setMask(paths.mask);
      shipped.timestamps = paths.timestamps;
      return shipped;
    }
  }
  if (paths.left.empty() && paths.stereo.empty() && (paths.depth.empty() || !paths.right.empty()))
    throw InputError(
        say(shown(folder), ": holds ", paths.right.empty() ? "no left view" : "a right view alone",
            ", but left/ and right/ with images, left.mp4 and right.mp4, or stereo.mp4 "
            "or depth/ are expected.",
            foundIn(folder)));
  if (!paths.left.empty() && paths.right.empty() && paths.depth.empty())
    throw InputError(shown(folder) +
                     ": holds a left view, but neither a right one nor depth/. Add one.");
  return paths;
}

}  // namespace softscope
