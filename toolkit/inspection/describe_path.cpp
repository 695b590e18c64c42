// toolkit/inspection/describe_path.cpp: kind of a folder by its content, of a file by its
// ending.
#include "toolkit/inspection/describe_path.h"

#include <filesystem>
#include <initializer_list>
#include <vector>

#include "core/error.h"
#include "io/sequences/dataset_form.h"
#include "io/sequences/dataset_search.h"
#include "io/sequences/sequence_paths.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/inspection/describe_file.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool hasEnding(const std::string& path, std::initializer_list<const char*> endings) {
  const std::string ending = lowerCase(fs::path(path).extension().string());
  for (const char* candidate : endings)
    if (ending == candidate) return true;
  return false;
}

/// One or two views, or depth only with a calibration.
bool looksLikeSequence(const fs::path& folder) {
  bool depth = false, calibration = false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    std::error_code ignored;  // the reader reports a dangling link
    const bool view = stem == "left" || stem == "right" || stem == "stereo";
    if (view && (entry.is_directory(ignored) || isVideo(entry.path()))) return true;
    depth |= stem == "depth" && entry.is_directory(ignored);
    calibration |= stem == "calibration";
  }
  return depth && calibration;
}

/// For a folder that is not readable itself: throws InputError if there are clips of data sets
/// below.
void nameClipsBelow(const std::string& folder) {
  const std::vector<FoundClip> clips = clipsBelow(folder);
  if (clips.empty()) return;
  throw InputError(say(shown(folder), ": is not a clip; clips below it: ", clips.size(),
                       ", the first of them ", shown(clips.front().folder), " (",
                       clips.front().form, "). Name one."));
}

FactSheet describeFolder(const std::string& path, const DescribeOptions& options) {
  if (looksLikeSequence(path) || recogniseDataset(path)) {
    const FactSheet facts = describeSequence(path, options.check_all);
    if (facts.hasProblems()) nameClipsBelow(path);
    return facts;
  }
  if (looksLikeVolume(path)) return describeVolume(path, options.volume);
  try {
    return describeCalibration(path);
  } catch (const InputError& error) {
    nameClipsBelow(path);
    throw InputError(path +
                     ": is neither a sequence (left/ and right/, left.mp4 and right.mp4, or "
                     "stereo.mp4) nor a DICOM series nor a calibration; as such: " +
                     error.what());
  }
}

FactSheet describeFile(const std::string& path, const DescribeOptions& options) {
  if (isPicture(path)) return describeImage(path);
  if (isVideo(path)) return describeVideo(path);
  if (hasEnding(path, {".pfm"})) return describeFloatMap(path);
  if (hasEnding(path, {".toml"})) return describeSettings(path);
  if (hasEnding(path, {".ply", ".stl", ".obj"})) return describeMesh(path);
  if (looksLikeVolume(path)) return describeVolume(path, options.volume);
  if (hasEnding(path, {".yaml", ".yml", ".xml", ".json", ".txt", ".ini", ".npy"}))
    return describeCalibration(path);
  throw InputError(
      path +
      ": unknown kind of file. Accepted: a sequence folder; images (png, jpg, "
      "bmp, tif, pgm, ppm), pfm, videos; meshes (ply, stl, obj); volumes (nii, nii.gz, "
      "nrrd, mha, DICOM); calibrations (yaml, xml, json, txt, ini, npy); settings "
      "(toml)");
}

}  // namespace

FactSheet describePath(const std::string& path, const DescribeOptions& options) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) throw InputError(path + ": does not exist, or is a dangling link");
  return fs::is_directory(status) ? describeFolder(path, options) : describeFile(path, options);
}

}  // namespace softscope
