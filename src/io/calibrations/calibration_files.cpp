#include "io/calibrations/calibration_files.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/documents/document.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;
using Found = std::optional<CalibrationFiles>;

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}
std::string lowerName(const fs::path& file) { return lowerCase(file.filename().string()); }

/// The single file whose lower-case name contains all `parts`.
std::optional<fs::path> onlyFileWith(const Files& files,
                                     const std::vector<std::string_view>& parts) {
  std::optional<fs::path> found;
  for (const fs::path& file : files) {
    const std::string name = lowerName(file);
    const bool fits = std::all_of(parts.begin(), parts.end(),
                                  [&](std::string_view part) { return contains(name, part); });
    if (!fits) continue;
    if (found) return std::nullopt;
    found = file;
  }
  return found;
}

Found openCasFive(const Files& texts) {
  const auto left = onlyFileWith(texts, {"left", "intrinsic"});
  const auto left_lens = onlyFileWith(texts, {"left", "distortion"});
  const auto right = onlyFileWith(texts, {"right", "intrinsic"});
  const auto right_lens = onlyFileWith(texts, {"right", "distortion"});
  const auto pose = onlyFileWith(texts, {"l2r"});
  if (!left || !left_lens || !right || !right_lens || !pose) return std::nullopt;
  return CalibrationFiles{CalibrationSet::kOpenCasFive,
                          {*left, *left_lens, *right, *right_lens, *pose}};
}

Found hamlynThree(const Files& texts) {
  const auto left = onlyFileWith(texts, {"left", "intrinsic"});
  const auto right = onlyFileWith(texts, {"right", "intrinsic"});
  const auto pose = onlyFileWith(texts, {"extrinsic"});
  if (!left || !right || !pose) return std::nullopt;
  return CalibrationFiles{CalibrationSet::kHamlynThree, {*left, *right, *pose}};
}

/// The same name with the last `from` replaced by `to`, if that file exists.
std::optional<fs::path> sibling(const fs::path& file, std::string_view from, std::string_view to) {
  std::string name = file.filename().string();
  const std::size_t at = lowerCase(name).rfind(from);
  if (at == std::string::npos) return std::nullopt;
  name.replace(at, from.size(), to);
  const fs::path found = file.parent_path() / name;
  return isFile(found) ? std::optional(found) : std::nullopt;
}

[[noreturn]] void failPartner(const fs::path& file, const char* found, const char* wanted) {
  throw InputError(
      say(shown(file), ": holds ", found, " alone; ", wanted, " is expected beside it."));
}

CalibrationFiles rosPair(const fs::path& file) {
  if (const auto right = sibling(file, "left", "right"))
    return {CalibrationSet::kRosPair, {file, *right}};
  if (const auto left = sibling(file, "right", "left"))
    return {CalibrationSet::kRosPair, {*left, file}};
  failPartner(file, "one camera's camera_info",
              "the other camera's, of the same name with left or right exchanged,");
}

CalibrationFiles openCvTwo(const fs::path& file, bool has_cameras) {
  if (const auto other = sibling(file, "intrinsics", "extrinsics"); other && has_cameras)
    return {CalibrationSet::kOpenCvTwo, {file, *other}};
  if (const auto other = sibling(file, "extrinsics", "intrinsics"); other && !has_cameras)
    return {CalibrationSet::kOpenCvTwo, {*other, file}};
  return {CalibrationSet::kOneFile, {file}};  // its reader reports missing parts
}

bool looksStructured(const fs::path& file) {
  const std::string kind = lowerCase(file.extension().string());
  return kind == ".yaml" || kind == ".yml" || kind == ".xml" || kind == ".json";
}

CalibrationFiles aroundStructured(const fs::path& file) {
  const Document document = parseDocument(readText(file, kCalibrationLimitBytes), shown(file));
  if (isCameraInfo(document)) return rosPair(file);
  const bool has_pose = document.find("R") && document.find("T");
  const bool has_cameras = document.find("M1") || document.find("K1");
  if (has_pose != has_cameras) return openCvTwo(file, has_cameras);
  return {CalibrationSet::kOneFile, {file}};
}

CalibrationFiles aroundFile(const fs::path& file) {
  requireFile(file);
  if (looksStructured(file)) return aroundStructured(file);
  const std::string name = lowerName(file);
  const bool is_part = contains(name, "intrinsic") || contains(name, "extrinsic") ||
                       contains(name, "distortion") || contains(name, "l2r");
  if (!is_part) return {CalibrationSet::kOneFile, {file}};
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Files texts = filesIn(folder, {".txt"});
  if (auto found = openCasFive(texts)) return *found;
  if (auto found = hamlynThree(texts)) return *found;
  return {CalibrationSet::kOneFile, {file}};
}

bool hasOpenCasHeader(const fs::path& file) {
  if (fs::file_size(file) < 3 || fs::file_size(file) > kCalibrationLimitBytes) return false;
  return trimmed(withoutByteOrderMark(readBytes(file, kCalibrationLimitBytes))).substr(0, 3) ==
         "RAT";
}

Found openCasOne(const Files& texts) {
  Found found;
  for (const fs::path& file : texts) {
    if (!hasOpenCasHeader(file)) continue;
    if (found)
      throw InputError(say(shown(file), ": a second OpenCAS calibration beside ",
                           shown(found->files[0].filename()), ". Name the one to use."));
    found = CalibrationFiles{CalibrationSet::kOneFile, {file}};
  }
  return found;
}

Found namedIn(const fs::path& folder) {
  for (const char* name : {"calibration.yaml", "calibration.yml", "calibration.xml",
                           "calibration.json", "endoscope_calibration.yaml", "frame_data.json",
                           "calib.json", "intrinsics.yml", "intrinsics.yaml", "intrinsics.xml",
                           "left.yaml", "left.yml", "left_rect.yaml", "StereoCalibration.ini"})
    if (isFile(folder / name)) return aroundFile(folder / name);
  return std::nullopt;
}

CalibrationFiles inFolder(const fs::path& folder) {
  if (auto found = namedIn(folder)) return *found;
  const Files texts = filesIn(folder, {".txt"});
  if (auto found = openCasOne(texts)) return *found;
  if (auto found = openCasFive(texts)) return *found;
  if (auto found = hamlynThree(texts)) return *found;
  if (const auto file = onlyFileWith(texts, {"calib"})) return {CalibrationSet::kOneFile, {*file}};
  if (isFile(folder / "poses_bounds.npy"))
    return {CalibrationSet::kOneFile, {folder / "poses_bounds.npy"}};
  throw InputError(shown(folder) +
                   ": holds no calibration. Add calibration.yaml (docs/formats.md) or "
                   "name the file.");
}

}  // namespace

CalibrationFiles locateCalibration(const fs::path& file_or_folder) {
  std::error_code code;
  return fs::is_directory(file_or_folder, code) ? inFolder(file_or_folder)
                                                : aroundFile(file_or_folder);
}

}  // namespace softscope
