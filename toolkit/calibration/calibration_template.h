// toolkit/calibration/calibration_template.h: commented calibration files to fill in.
#pragma once

#include <string>
#include <vector>

namespace softscope {

/// stereo, rectified, rgb-d.
const std::vector<std::string>& calibrationTemplateNames();

/// YAML that reads as it is, with plausible numbers to replace and what each means. Throws
/// OptionError with the nearest name.
std::string calibrationTemplate(const std::string& kind);

}  // namespace softscope
