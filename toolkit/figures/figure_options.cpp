// toolkit/figures/figure_options.cpp: checks of names, ranges and file extensions.
#include "toolkit/figures/figure_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/error.h"
#include "core/nearest_name.h"
#include "io/files/atomic_file.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/comparison/landmark_places.h"
#include "vtk_views/scenes/four_panels.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModel = "model";

void requireEnding(const std::string& file) {
  const std::string ending = fs::path(file).extension().string();
  if (ending != ".png" && ending != ".pdf" && ending != ".svg")
    throw OptionError("`out=` is `" + file + "`, but must end in .png, .pdf or .svg");
}

/// Empty unless the text has three finite numbers.
std::optional<Eigen::Vector3d> vectorOf(const std::string& text) {
  const auto words = wordsOf(text);
  if (words.size() != 3) return std::nullopt;
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = numberOf(words[i]);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    vector[Eigen::Index(i)] = *value;
  }
  return vector;
}

Eigen::Vector3d parsePlace(const std::string& at) {
  if (const auto place_mm = vectorOf(at)) return *place_mm;
  throw OptionError("`at=` is `" + at + "`, but must be three numbers, e.g. 1,2,3, or `" + kModel +
                    "`, or with `landmarks=` FILE the name of one");
}

}  // namespace

Eigen::Vector3d parseVector(const std::string& text, const std::string& option) {
  if (const auto vector = vectorOf(text)) return *vector;
  throw OptionError(option + " is `" + text + "`, but must be three numbers, e.g. 1,2,3");
}

void FigureOptions::validate() const {
  std::set<std::filesystem::path> files;
  for (const std::string& file : out) {
    requireEnding(file);
    requireWritable(file, force);
    if (!files.insert(std::filesystem::path(file).lexically_normal()).second)
      throw OptionError("`out=` names " + file + " twice; name each file once");
  }
  requireWritable(recordFile(), force);
  const auto positive = [](const char* name, double value) {
    require(value == 0 || (value > 0 && std::isfinite(value)), name, value, "must be above 0");
  };
  positive("`field_mm=`", field_mm);
  require(dot_reach_mm > 0, "`dots_within_mm=`", dot_reach_mm, "must be above 0");
  require(width_mm == 0 || (width_mm >= 40 && width_mm <= 1000), "`width_mm=`", width_mm,
          "must be 40 to 1000");
  require(dots_per_inch == 0 || (dots_per_inch >= 30 && dots_per_inch <= 2400), "`dots_per_inch=`",
          dots_per_inch, "must be 30 to 2400");
  figureStyle();
  namedPlace();
  volume.options();
}

FigureStyle FigureOptions::figureStyle() const {
  FigureStyle chosen = softscope::figureStyle(style);
  if (width_mm > 0) chosen.width_mm = width_mm;
  if (dots_per_inch > 0) chosen.dots_per_inch = dots_per_inch;
  return chosen;
}

std::optional<Eigen::Vector3d> FigureOptions::namedPlace() const {
  require(landmarks.empty() || !at.empty(), "`landmarks=`", landmarks,
          "needs `at=` NAME, one of them");
  if (at.empty() || at == kModel) return std::nullopt;
  if (landmarks.empty()) return parsePlace(at);
  const LandmarkPlaces places = readLandmarkPlaces(landmarks);
  if (const auto found = places.find(at); found != places.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, place_mm] : places) names.push_back(name);
  const std::string nearest = nearestName(at, names);
  throw OptionError("`at=` `" + at + "`: " + shown(landmarks) + " has no such landmark" +
                    (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)"));
}

Eigen::Vector3d FigureOptions::centreIn(const Scene& scene, const SceneSurface* model) const {
  if (at != kModel) return namedPlace().value_or(sceneCentre(scene));
  if (model == nullptr) throw OptionError("`at=` model: there is no model; give one, or X,Y,Z");
  return middleOf({*model}).median_mm;
}

fs::path FigureOptions::recordFile() const {
  return out.empty() ? fs::path() : fs::path(out.front()).replace_extension(".json");
}

}  // namespace softscope
