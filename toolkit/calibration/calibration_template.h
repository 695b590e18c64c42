// toolkit/calibration/calibration_template.h: commented templates of calibration files.
#pragma once

#include <string>
#include <vector>

namespace softscope {

/// stereo, rectified, rgb-d.
const std::vector<std::string>& calibrationTemplateNames();

/// Valid YAML with plausible example values and the meaning
/// of each. Throws OptionError with the nearest name.
std::string calibrationTemplate(const std::string& kind);

}  // namespace softscope
