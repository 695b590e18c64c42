#include "io/sequences/shipped_folders.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/calibrations/calibration_reader.h"
#include "io/datasets/c3vd_files.h"
#include "io/files/folder.h"
#include "io/sequences/picture_source.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kSameMomentS = 0.005;  // a sixth of the frame time

std::vector<fs::path> imagesIn(const fs::path& folder) {
  return filesIn(folder, {kPictureKinds.begin(), kPictureKinds.end()});
}

/// The only video of a folder.
fs::path onlyVideo(const fs::path& folder, const char* form) {
  const std::vector<fs::path> videos = filesIn(folder, {".mp4", ".avi", ".mkv", ".mov"});
  if (videos.size() != 1)
    throw InputError(say(shown(folder), ": holds ", videos.size(), " videos, but one is expected (",
                         form, "). Download it again."));
  return videos[0];
}

void requirePart(const fs::path& part, const char* form) {
  if (!isThere(part))
    throw InputError(say(shown(part), ": is missing, but ", form, " has it. Download it again."));
}

/// Every pair has its own calibration; in a sequence they must be equal.
fs::path oneCalibration(const fs::path& folder) {
  const std::vector<fs::path> files = filesIn(folder, {".json"});
  if (files.empty())
    throw InputError(shown(folder) +
                     ": holds no calibration, but NNN.json are expected (SERV-CT).");
  const StereoCalibration first = readCalibration(files[0]);
  for (const fs::path& file : files) {
    const StereoCalibration other = readCalibration(file);
    if (std::abs(other.left.pinhole.fx_px - first.left.pinhole.fx_px) > 1e-6 ||
        std::abs(other.left.pinhole.cx_px - first.left.pinhole.cx_px) > 1e-6 ||
        std::abs(other.baseline_mm() - first.baseline_mm()) > 1e-6)
      throw InputError(say(shown(file), ": differs from ", shown(files[0].filename()),
                           ", but a sequence has one calibration. Give its pairs one by one: LEFT "
                           "RIGHT with NNN.json as `calibration=`."));
  }
  return files[0];
}

DatasetClip servCt(const fs::path& folder) {
  DatasetClip clip;
  clip.form = "SERV-CT";
  clip.benchmark = "servct";
  clip.paths.left = folder / "Left_rectified";
  clip.paths.right = folder / "Right_rectified";
  requirePart(clip.paths.right, "an experiment of SERV-CT");
  requirePart(folder / "Rectified_calibration", "an experiment of SERV-CT");
  clip.paths.calibration = oneCalibration(folder / "Rectified_calibration");
  clip.truth = existingIn(folder, {"Reference_CT", "Reference_RGB"});
  return clip;
}

DatasetClip stereoMis(const fs::path& folder) {
  DatasetClip clip;
  clip.form = "StereoMIS";
  clip.benchmark = "stereomis";
  clip.paths.stereo = onlyVideo(folder, "StereoMIS");
  clip.paths.calibration = folder / "StereoCalibration.ini";
  clip.paths.layout = "top-bottom";
  if (isThere(folder / "masks")) {
    clip.paths.mask = folder / "masks";
    clip.paths.tissue_masks = true;
  }
  clip.truth = existingIn(folder, {"groundtruth.txt", "train_split.csv", "test_split.csv"});
  return clip;
}

/// camera_info of the clip, else of its recording two folders up.
fs::path cameraInfo(const fs::path& folder, const char* name) {
  for (const fs::path& place : {folder / "camera_info", folder / ".." / ".." / "camera_info"})
    if (isFile(place / name)) return place / name;
  throw InputError(say(shown(folder / "camera_info" / name),
                       ": is missing, but a clip of D4D or its recording has it. Download it "
                       "again."));
}

DatasetClip d4d(const fs::path& folder, bool rectified) {
  DatasetClip clip;
  clip.form = "D4D";
  clip.paths.left = folder / (rectified ? "left_images_rect" : "left_images");
  clip.paths.right = folder / (rectified ? "right_images_rect" : "right_images");
  clip.paths.calibration = cameraInfo(folder, rectified ? "left_rect.yaml" : "left.yaml");
  clip.paths.rectified = rectified;
  StampedPairs pairs = pairByStamp(imagesIn(clip.paths.left), imagesIn(clip.paths.right));
  clip.paths.left_files = std::move(pairs.left);
  clip.paths.right_files = std::move(pairs.right);
  clip.paths.times_s = std::move(pairs.times_s);
  clip.truth = existingIn(
      folder, {"curated_camera_pose_start.txt", "curated_camera_pose_end.txt", "pointcloud"});
  return clip;
}

/// PATIENT/left…/seqNN, its partner PATIENT/right…/seqNN.
DatasetClip stirToEnd2025(const fs::path& given) {
  const fs::path folder = fs::absolute(given).lexically_normal();
  const fs::path own = folder.has_filename() ? folder : folder.parent_path();
  std::string side = own.parent_path().filename().string();
  const std::size_t at = side.find("left");
  if (at == std::string::npos)
    throw InputError(say(shown(given), ": is a sequence of STIR, but its folder's name, ",
                         excerpt(side), ", has no left in it. Give PATIENT/left…/seqNN."));
  side.replace(at, 4, "right");
  DatasetClip clip;
  clip.form = "STIR";
  clip.benchmark = "stir";
  clip.paths.left = onlyVideo(given / "frames", "STIR");
  const fs::path right = own.parent_path().parent_path() / side / own.filename() / "frames";
  requirePart(right, "STIR's other view");
  clip.paths.right = onlyVideo(right, "STIR");
  clip.paths.calibration = own.parent_path().parent_path() / "calib.json";
  requirePart(clip.paths.calibration, "STIR");
  clip.truth = existingIn(given, {"segmentation/icgstartseg.png", "segmentation/icgendseg.png"});
  return clip;
}

DatasetClip hamlynMirror(const fs::path& folder) {
  DatasetClip clip;
  clip.form = "Hamlyn";
  clip.paths.left = folder / "image01";
  clip.paths.right = folder / "image02";
  clip.paths.calibration = folder;
  clip.paths.rectified = true;
  return clip;  // depth01 is the result of a matcher, not ground truth
}

/// NNNN_color.png with NNNN_depth.tiff of the same number in one folder.
DatasetClip c3vd(const fs::path& folder) {
  DatasetClip clip;
  clip.form = "C3VD";
  clip.benchmark = "c3vd";
  clip.paths.left = clip.paths.depth = clip.paths.calibration = folder;
  clip.paths.depth_unit_mm = kC3vdStepMm;
  clip.paths.rectified = true;
  for (const fs::path& image : imagesIn(folder)) {
    std::string stem = image.stem().string();
    const std::size_t at = stem.find("_color");
    if (at == std::string::npos) continue;
    stem.replace(at, 6, "_depth");
    fs::path depth;
    for (const char* kind : {".tiff", ".tif", ".png"})
      if (isFile(folder / (stem + kind))) depth = folder / (stem + kind);
    if (depth.empty())
      throw InputError(say(shown(folder / (stem + ".tiff")),
                           ": is missing, but C3VD has a depth "
                           "for each image. Download it again."));
    clip.paths.left_files.push_back(image);
    clip.paths.depth_files.push_back(depth);
  }
  if (clip.paths.left_files.empty())
    throw InputError(shown(folder) + ": holds no NNNN_color.png, but C3VD's sequences do.");
  clip.truth = existingIn(folder, {"pose.txt"});
  return clip;
}

}  // namespace

std::optional<double> stampOf(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t at = stem.find('_');
  if (at == std::string::npos) return std::nullopt;
  const auto seconds = numberOf(stem.substr(0, at)), nano = numberOf(stem.substr(at + 1));
  if (!seconds || !nano || !(*seconds >= 0 && *seconds < 1e12) || !(*nano >= 0 && *nano < 1e9))
    return std::nullopt;
  return *seconds + 1e-9 * *nano;
}

StampedPairs pairByStamp(const std::vector<fs::path>& left, const std::vector<fs::path>& right) {
  const auto stamped = [](const std::vector<fs::path>& files) {
    std::vector<std::pair<double, fs::path>> out;
    for (const fs::path& file : files) {
      const auto stamp = stampOf(file);
      if (!stamp)
        throw InputError(shown(file) +
                         ": its name is no SECONDS_NANOSECONDS, but D4D's images are named so.");
      out.emplace_back(*stamp, file);
    }
    std::sort(out.begin(), out.end());
    return out;
  };
  const auto lefts = stamped(left), rights = stamped(right);
  StampedPairs pairs;
  std::size_t r = 0;
  for (const auto& [time_s, file] : lefts) {
    while (r < rights.size() && rights[r].first < time_s - kSameMomentS) ++r;
    while (r + 1 < rights.size() &&
           std::abs(rights[r + 1].first - time_s) < std::abs(rights[r].first - time_s))
      ++r;
    if (r == rights.size() || std::abs(rights[r].first - time_s) > kSameMomentS) continue;
    pairs.left.push_back(file);
    pairs.right.push_back(rights[r++].second);
    pairs.times_s.push_back(time_s - lefts[0].first);
  }
  if (pairs.left.empty())
    throw InputError(say("of ", left.size(), " left and ", right.size(),
                         " right images no two are of one moment (stamps within 5 ms); are they of "
                         "one clip?"));
  return pairs;
}

std::optional<DatasetClip> recogniseShippedFolder(const fs::path& folder) {
  if (isFolder(folder / "Left_rectified")) return servCt(folder);
  if (isFile(folder / "StereoCalibration.ini")) return stereoMis(folder);
  if (isFolder(folder / "left_images_rect")) return d4d(folder, true);
  if (isFolder(folder / "left_images") && isFolder(folder / "right_images"))
    return d4d(folder, false);
  if (isFolder(folder / "frames") && isFolder(folder / "segmentation"))
    return stirToEnd2025(folder);
  if (isFolder(folder / "image01") && isFolder(folder / "image02")) return hamlynMirror(folder);
  if (isFile(folder / "pose.txt")) return c3vd(folder);
  return std::nullopt;
}

}  // namespace softscope
