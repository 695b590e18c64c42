#include "io/calibrations/calibration_reader.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/length_unit.h"
#include "io/calibrations/calibration_check.h"
#include "io/calibrations/calibration_files.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_settings.h"
#include "io/calibrations/lens_model.h"
#include "io/documents/npy_file.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kLongestSidePx = 100000;

double millimetresPer(const std::string& unit, const std::string& name) {
  if (const auto known = lengthUnitNamed(unit)) return known->mm;
  throw InputError(say(name, ": unit is ", excerpt(unit), ", but mm, cm or m is expected."));
}

void setBaseline(const CalibrationDraft& draft, const CalibrationHints& hints,
                 StereoCalibration& out) {
  Eigen::Vector3d t = out.right_from_left.translation();
  if (hints.baseline_mm > 0) {
    t = draft.has_baseline && t.norm() > 0 ? Eigen::Vector3d(t * (hints.baseline_mm / t.norm()))
                                           : Eigen::Vector3d(-hints.baseline_mm, 0, 0);
  } else if (!draft.has_baseline) {
    throw InputError(out.source +
                     ": this format has no baseline. Give it in mm: calibration.baseline_mm=… (4.3 "
                     "for a da Vinci Si).");
  }
  out.right_from_left.translation() = t;
}

void setSize(const CalibrationHints& hints, PinholeCamera& camera) {
  const auto [width_px, height_px] = hints.imageSizePx();
  if (camera.width_px == 0) camera.width_px = width_px;
  if (camera.height_px == 0) camera.height_px = height_px;
}

StereoCalibration finish(const CalibrationDraft& draft, const std::string& name,
                         const CalibrationHints& hints) {
  StereoCalibration out = draft.calibration;
  out.source = name;
  const std::string& unit = hints.unit.empty() ? draft.unit : hints.unit;
  out.right_from_left.translation() *= millimetresPer(unit, name);
  setBaseline(draft, hints, out);
  setSize(hints, out.left.pinhole);
  setSize(hints, out.right.pinhole);
  out.rectified = out.rectified || hints.rectified;
  for (std::string& line : checkCalibration(out, unit)) out.warnings.push_back(std::move(line));
  for (std::string& line : checkPictureFit(out)) out.warnings.push_back(std::move(line));
  return out;
}

bool isScaredName(const std::string& name) {
  return fs::path(name).filename() == "endoscope_calibration.yaml";
}

Document documentOf(const NamedText& file) {
  Document document = parseDocument(file.text, file.name);
  requirePinholeLens(document, file.name);
  return document;
}

CalibrationDraft draftFromDocument(const Document& document, const std::string& name) {
  if (isCameraInfo(document))
    throw InputError(name +
                     ": one camera's camera_info, but those of both are expected. Give the "
                     "left one with the right one beside it.");
  if (document.find("P0") && document.find("P1"))
    throw InputError(name +
                     ": P0 and P1 are names of KITTI, whose pairs are P0 and P1 (grey) or P2 and "
                     "P3 (colour), in metres. Write the pair of the images as f, cx, cy and "
                     "baseline (`softscope calibration-template rectified`).");
  if (document.find("P1") && document.find("P2") && !document.find("M1") && !document.find("R"))
    return draftFromProjections(document, name);
  const Document* scared = document.find("camera-calibration");
  if (!scared && holdsFewNumbers({document})) return draftFromFewNumbers({document}, name);
  CalibrationDraft draft = draftFromOpenCv({scared ? *scared : document}, name);
  if (scared || isScaredName(name)) draft.calibration.form = "SCARED";
  return draft;
}

/// True if most lines with content contain only numbers: a text without
/// names. JSON and XML may also contain such lines, but begin with a bracket.
bool isBareNumbers(std::string_view text) {
  const std::string_view content = trimmed(text);
  if (!content.empty() && (content[0] == '{' || content[0] == '<')) return false;
  std::size_t lines = 0;
  for (const std::string_view line : linesOf(text)) lines += trimmed(line).empty() ? 0 : 1;
  return 2 * numberRows(text).size() >= lines && lines > 0;
}

CalibrationDraft draftFromBytes(std::string_view content_bytes, const std::string& name) {
  const std::string_view bytes = utf8Text(content_bytes, name);
  if (isNpy(bytes)) return draftFromEndoNerf(bytes, name);
  const std::string_view content = trimmed(bytes);
  if (content.empty()) throw InputError(name + ": the file is empty. Copy or export it again.");
  if (content.substr(0, 3) == "RAT") return draftFromOpenCas(NamedText{name, bytes});
  if (content[0] != '{' && content.find("[StereoLeft]") != std::string_view::npos)
    return draftFromIni(bytes, name);
  if (isBareNumbers(bytes)) return draftFromHamlyn(NamedText{name, bytes});
  return draftFromDocument(documentOf({name, bytes}), name);
}

std::vector<Document> documentsOf(const std::vector<NamedText>& texts) {
  std::vector<Document> documents;
  for (const NamedText& file : texts) documents.push_back(documentOf(file));
  return documents;
}

CalibrationDraft draftFromSet(CalibrationSet set, const std::vector<NamedText>& texts,
                              const CalibrationHints& hints) {
  const std::string& name = texts[0].name;
  switch (set) {
    case CalibrationSet::kOpenCvTwo:
      return draftFromOpenCv(documentsOf(texts), name);
    case CalibrationSet::kRosPair: {
      const std::vector<Document> both = documentsOf(texts);
      return draftFromRos(both[0], both[1], name, hints.rectified);
    }
    case CalibrationSet::kHamlynThree:
      return draftFromHamlyn(HamlynFiles{texts[0], texts[1], texts[2]});
    case CalibrationSet::kOpenCasFive:
      return draftFromOpenCas(OpenCasFiles{texts[0], texts[1], texts[2], texts[3], texts[4]});
    case CalibrationSet::kOneFile:
      break;
  }
  return draftFromBytes(texts[0].text, name);
}

}  // namespace

std::pair<int, int> CalibrationHints::imageSizePx() const {
  if (image_size.empty()) return {0, 0};
  const std::string_view text = image_size;
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto length = [](std::string_view word) {  // 0: none
    const double value = numberOf(word).value_or(0);
    return value >= 1 && value <= kLongestSidePx && value == std::floor(value) ? int(value) : 0;
  };
  const int width = length(text.substr(0, cross));
  const int height = cross < text.size() ? length(text.substr(cross + 1)) : 0;
  require(width > 0 && height > 0, "calibration.image_size", image_size,
          "must be WIDTHxHEIGHT in pixels, such as 640x480");
  return {width, height};
}

void CalibrationHints::validate() const {
  requireAllowed(*this);
  imageSizePx();
}

StereoCalibration readCalibration(const fs::path& file_or_folder, const CalibrationHints& hints) {
  hints.validate();
  const CalibrationFiles files = locateCalibration(file_or_folder);
  std::vector<std::string> contents;
  for (const fs::path& file : files.files)
    contents.push_back(readText(file, kCalibrationLimitBytes));
  std::vector<NamedText> texts;
  for (std::size_t i = 0; i < contents.size(); ++i)
    texts.push_back({shown(files.files[i]), contents[i]});
  return finish(draftFromSet(files.set, texts, hints), texts[0].name, hints);
}

StereoCalibration parseCalibration(std::string_view bytes, const std::string& name,
                                   const CalibrationHints& hints) {
  hints.validate();
  return finish(draftFromBytes(bytes, name), name, hints);
}

}  // namespace softscope
