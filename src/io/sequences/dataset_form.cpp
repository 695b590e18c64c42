#include "io/sequences/dataset_form.h"

#include "core/error.h"
#include "io/datasets/surgt_files.h"
#include "io/files/folder.h"
#include "io/sequences/shipped_folders.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> videosIn(const fs::path& folder) {
  std::vector<fs::path> videos;
  for (const fs::path& file : filesIn(folder, {".mp4", ".avi", ".mkv", ".mov", ".webm"}))
    if (isVideo(file)) videos.push_back(file);
  return videos;
}

/// Names of the videos of STIR 2026 are not published: one with `left`
/// and one with `right` in its name, else one video with both views.
DatasetClip stir2026(const fs::path& folder) {
  DatasetClip clip;
  clip.form = "STIR 2026";
  clip.benchmark = "stir2026";
  clip.paths.calibration = folder / "calib.json";
  clip.truth = existingIn(folder, {"annotations.json", "queries.json"});
  const std::vector<fs::path> videos = videosIn(folder);
  for (const fs::path& video : videos) {
    const std::string name = lowerCase(video.filename().string());
    if (name.find("left") != std::string::npos) clip.paths.left = video;
    if (name.find("right") != std::string::npos) clip.paths.right = video;
  }
  if (!clip.paths.left.empty() && !clip.paths.right.empty()) return clip;
  if (videos.size() != 1 || !clip.paths.left.empty() || !clip.paths.right.empty())
    throw InputError(say(shown(folder), ": is a clip of STIR 2026 with ", videos.size(),
                         " videos, but one with left and one with right in its name, or one with "
                         "both views, is expected."));
  clip.paths.stereo = videos[0];
  return clip;
}

DatasetClip surgt(const fs::path& folder) {
  const SurgtInfo info = readSurgtInfo(folder / "info.yaml");
  DatasetClip clip;
  clip.form = "SurgT";
  clip.benchmark = "surgt";
  clip.paths.stereo = folder / info.video;
  clip.paths.calibration = folder / "calibration.yaml";
  clip.paths.layout = info.side_by_side ? "side-by-side" : "top-bottom";
  clip.truth = existingIn(folder, info.truth);
  for (const fs::path& part : {clip.paths.stereo, clip.paths.calibration})
    if (!isFile(part))
      throw InputError(shown(part) +
                       ": is missing, but a clip of SurgT has it. Download it again.");
  return clip;
}

DatasetClip scared(const fs::path& folder) {
  DatasetClip clip;
  clip.form = "SCARED";
  clip.benchmark = "scared";
  clip.paths.left = folder / "Left_Image.png";
  clip.paths.right = folder / "Right_Image.png";
  clip.paths.calibration = folder / "endoscope_calibration.yaml";
  clip.truth = existingIn(folder, {"left_depth_map.tiff", "right_depth_map.tiff"});
  for (const fs::path& part : {clip.paths.right, clip.paths.calibration})
    if (!isFile(part))
      throw InputError(shown(part) +
                       ": is missing, but a keyframe of SCARED has it. Unpack it again.");
  return clip;
}

}  // namespace

std::optional<DatasetClip> recogniseDataset(const fs::path& folder) {
  std::optional<DatasetClip> clip;
  if (isFile(folder / "calib.json") &&
      (isFile(folder / "queries.json") || isFile(folder / "annotations.json")))
    clip = stir2026(folder);
  else if (isFile(folder / "info.yaml"))
    clip = surgt(folder);
  else if (isFile(folder / "Left_Image.png"))
    clip = scared(folder);
  else
    clip = recogniseShippedFolder(folder);
  if (clip) clip->paths.form = clip->form;
  return clip;
}

}  // namespace softscope
