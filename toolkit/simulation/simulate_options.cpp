// toolkit/simulation/simulate_options.cpp: keys of a scenario.
#include "toolkit/simulation/simulate_options.h"

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "core/nearest_name.h"
#include "eval/simulation/sequence/simulation_settings.h"
#include "io/text/text_lines.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, SimulateOptions& o) {
  v("frames", o.frames, between(1, 1000000), "of the sequence");
  v("pictures", o.pictures, oneOf({"png", "jpg", "mp4"}), "files of the images");
  v("jpeg_quality", o.jpeg_quality, between(1, 100), "1 small to 100 good");
  v("masks", o.masks, "mask/ of the instrument in the left image");
  v("input_depth", o.input_depth, "true depth as depth/, which replaces stereo");
  v("truth_every", o.truth_every, atLeast(1), "frames between true meshes and depths");
  v("organ.mesh", o.organ, FreeText{"builtin or a mesh file (STL, PLY, OBJ, VTP)"}, "surface");
  v("organ.unit_mm", o.organ_unit_mm, between(0, 1e6),
    "of a mesh file: 1000 for metres; 0: as it states, else mm");
  v("texture.picture", o.texture, FreeText{"a photograph or empty"}, "empty: procedural tissue");
  describe(v, o.simulation);
}

void SimulateOptions::validate() const {
  requireAllowed(*this);
  require(!organ.empty(), "organ.mesh", "``", "must be builtin or a file");
  simulation.validate();
  require(!input_depth || simulation.scope.lens().distortion.isZero(), "input_depth", "true",
          "needs lenses without distortion: depth files belong to rectified images");
}

SettingsBinder settingsOf(SimulateOptions& options) {
  SettingsBinder binder;
  describe(binder, options);
  return binder;
}

void setPictureSize(const std::string& text, ScopeOptions& scope) {
  const auto cross = text.find('x');
  const auto width = numberOf(text.substr(0, cross));
  const auto height = cross == std::string::npos ? std::nullopt : numberOf(text.substr(cross + 1));
  const auto fits = [](double n) { return n >= 32 && n <= 8192 && n == static_cast<int>(n); };
  if (!width || !height || !fits(*width) || !fits(*height))
    throw OptionError("`size=` is `" + text +
                      "`, but must be WIDTHxHEIGHT, each 32 to 8192 px, e.g. 640x480");
  scope.width_px = static_cast<int>(*width);
  scope.height_px = static_cast<int>(*height);
}

TruthKinds TruthKinds::parse(const std::string& list) {
  if (list.empty()) return {};
  TruthKinds kinds{false, false, false, false, false, false};
  if (list == "none") return kinds;
  const std::vector<std::string> names{"mesh", "depth", "trajectory", "tracks", "normals", "flow"};
  bool* const fields[] = {&kinds.mesh,   &kinds.depth,   &kinds.trajectory,
                          &kinds.tracks, &kinds.normals, &kinds.flow};
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      const std::string nearest = nearestName(word, names);
      throw OptionError("`truth=`: `" + word + "` is no kind of truth" +
                        (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)") +
                        ". Give some of mesh,depth,trajectory,tracks,normals,flow, or none");
    }
    *fields[found - names.begin()] = true;
  }
  return kinds;
}

}  // namespace softscope
