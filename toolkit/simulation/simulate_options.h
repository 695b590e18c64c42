// toolkit/simulation/simulate_options.h: options of `softscope simulate`.
#pragma once

#include <string>

#include "eval/simulation/sequence/simulation_options.h"
#include "io/settings/settings_binder.h"

namespace softscope {

struct SimulateOptions {
  int frames = 40;
  int truth_every = 5;            // mesh and depth of every n-th and the last frame
  std::string organ = "builtin";  // or a mesh file
  double organ_unit_mm = 0;       // of a mesh file; 0: as it states
  std::string texture = "";       // an image file; empty: procedural tissue
  std::string pictures = "png";   // or jpg, mp4
  int jpeg_quality = 95;          // of jpg
  bool masks = true;              // mask/, for a scene with an instrument
  bool input_depth = false;       // also write the true depth as input of the sequence
  SimulationOptions simulation;

  /// Throws OptionError.
  void validate() const;
  bool builtinOrgan() const { return organ == "builtin"; }
};

/// Every key of a scenario. The options must outlive the binder.
SettingsBinder settingsOf(SimulateOptions& options);

/// "640x480" as width and height. Throws OptionError.
void setPictureSize(const std::string& text, ScopeOptions& scope);

/// Selection of ground truth files.
struct TruthKinds {
  bool mesh = true, depth = true, trajectory = true, tracks = true;
  bool normals = false, flow = false;

  /// "mesh,depth"; empty = the four usual, "none" = none. Throws OptionError with the nearest name.
  static TruthKinds parse(const std::string& list);
};

}  // namespace softscope
