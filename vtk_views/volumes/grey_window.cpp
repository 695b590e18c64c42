// vtk_views/volumes/grey_window.cpp: presets of radiology.
#include "vtk_views/volumes/grey_window.h"

#include <algorithm>
#include <cmath>

#include "core/decimal_number.h"
#include "core/error.h"

namespace softscope {
namespace {

const std::vector<GreyWindow>& presets() {
  static const std::vector<GreyWindow> kPresets{{"soft-tissue", 400, 40},
                                                {"lung", 1500, -600},
                                                {"bone", 1800, 400},
                                                {"liver", 150, 90},
                                                {"vessels", 700, 200}};
  return kPresets;
}

GreyWindow middleOf(const Volume& volume) {
  const double low = volume.percentile(0.01), high = volume.percentile(0.99);
  return {"middle 98 % of the values", std::max(high - low, 1e-6), (low + high) / 2};
}

}  // namespace

std::uint8_t GreyWindow::grey(double value) const {
  if (std::isnan(value)) return 0;
  const double share = std::clamp((value - level) / width + 0.5, 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(255 * share));
}

std::vector<std::string> windowNames() {
  std::vector<std::string> names{"auto"};
  for (const GreyWindow& preset : presets()) names.push_back(preset.name);
  return names;
}

GreyWindow parseWindow(const std::string& text, const Volume& volume) {
  if (text == "auto") return volume.inHounsfield() ? presets()[0] : middleOf(volume);
  for (const GreyWindow& preset : presets()) {
    if (text != preset.name) continue;
    if (!volume.inHounsfield())
      throw OptionError("`window=` " + text +
                        " is in Hounsfield units, but the volume's values aren't; give auto or "
                        "WIDTH,LEVEL");
    return preset;
  }
  GreyWindow window;
  const std::size_t comma = std::min(text.find(','), text.size());
  const std::string_view words = text;
  const auto width = decimalNumber<double>(words.substr(0, comma));
  const auto level = decimalNumber<double>(words.substr(std::min(comma + 1, text.size())));
  window.width = width.value_or(0);
  window.level = level.value_or(std::nan(""));
  if (!(window.width > 0) || !std::isfinite(window.width) || !std::isfinite(window.level)) {
    std::string names;
    for (const std::string& name : windowNames()) names += name + ", ";
    throw OptionError("`window=` is `" + text + "`, but must be " + names +
                      "or WIDTH,LEVEL with a width above 0");
  }
  return window;
}

}  // namespace softscope
