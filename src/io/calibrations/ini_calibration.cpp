// src/io/calibrations/ini_calibration.cpp: StereoCalibration.ini of StereoMIS.
#include <map>

#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_parts.h"
#include "io/calibrations/lens_model.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

/// section.key, lower case, to value.
using IniValues = std::map<std::string, double>;

IniValues iniValues(std::string_view text, const std::string& name) {
  IniValues values;
  std::string section;
  int number = 0;
  for (const std::string_view whole : linesOf(text)) {
    ++number;
    const std::string_view line = trimmed(whole);
    if (line.empty() || line[0] == ';' || line[0] == '#') continue;
    if (line[0] == '[' && line.back() == ']') {
      section = lowerCase(line.substr(1, line.size() - 2));
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
      throw InputError(say(name, ": line ", number, " is ", excerpt(line),
                           ", but [SECTION] or KEY=VALUE is expected."));
    const std::string_view key = trimmed(line.substr(0, equals));
    const std::string_view text_value = trimmed(line.substr(equals + 1));
    requirePinholeLens(key, text_value, name);
    if (const auto value = numberOf(text_value)) values[section + "." + lowerCase(key)] = *value;
  }
  return values;
}

double needed(const IniValues& values, const std::string& key, const std::string& name) {
  const auto found = values.find(key);
  if (found == values.end())
    throw InputError(say(name, ": ", key,
                         " is missing or no number, but StereoCalibration.ini has it. Download it "
                         "again."));
  return found->second;
}

std::vector<double> numbered(const IniValues& values, const std::string& key, int count,
                             const std::string& name) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(needed(values, say(key, i), name));
  return out;
}

RawCamera iniCamera(const IniValues& values, const std::string& section, const std::string& name) {
  const auto value = [&](const char* key) { return needed(values, section + key, name); };
  RawCamera camera;
  setCameraMatrix(camera.pinhole,
                  {value("fc_x"), 0, value("cc_x"), 0, value("fc_y"), value("cc_y"), 0, 0, 1},
                  say(name, ": ", section, "fc_x"));
  camera.pinhole.width_px = wholePixels(value("res_x"), 0, say(name, ": ", section, "res_x"));
  camera.pinhole.height_px = wholePixels(value("res_y"), 0, say(name, ": ", section, "res_y"));
  camera.distortion =
      distortionFrom(numbered(values, section + "kc_", 5, name), say(name, ": ", section, "kc"));
  return camera;
}

}  // namespace

CalibrationDraft draftFromIni(std::string_view text, const std::string& name) {
  const IniValues values = iniValues(text, name);
  CalibrationDraft draft;
  draft.calibration.form = "StereoMIS";
  draft.calibration.left = iniCamera(values, "stereoleft.", name);
  draft.calibration.right = iniCamera(values, "stereoright.", name);
  draft.calibration.right_from_left =
      poseFrom(numbered(values, "stereoright.r_", 9, name),
               numbered(values, "stereoright.t_", 3, name), name + ": R", name + ": T");
  return draft;
}

}  // namespace softscope
