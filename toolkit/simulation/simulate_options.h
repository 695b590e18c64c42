// toolkit/simulation/simulate_options.h: options of `softscope simulate`.
#pragma once

#include <string>

#include "eval/simulation/sequence/simulation_options.h"
#include "io/settings/settings_binder.h"

namespace softscope {

struct SimulateOptions {
  int frames = 40;
  int truth_every = 5;            // mesh and depth of every so manieth frame, and of the last
  std::string organ = "builtin";  // or a mesh file
  double organ_unit_mm = 1;       // of a mesh file
  std::string texture = "";       // an image file; empty: procedural tissue
  std::string pictures = "png";   // or jpg, mp4
  int jpeg_quality = 95;          // of jpg
  bool masks = true;              // mask/, where there is an instrument
  bool input_depth = false;       // write the true depth of every frame as the sequence's own
  SimulationOptions simulation;

  /// Throws OptionError.
  void validate() const;
  bool builtinOrgan() const { return organ == "builtin"; }
};

/// Every key of a scenario. The options must outlive the binder.
SettingsBinder settingsOf(SimulateOptions& options);

/// "640x480" to width and height. Throws OptionError.
void setPictureSize(const std::string& text, ScopeOptions& scope);

/// Which truth is written.
struct TruthKinds {
  bool mesh = true, depth = true, trajectory = true, tracks = true;
  bool normals = false, flow = false;

  /// "mesh,depth"; empty = the usual four, "none" = none. Throws OptionError with the nearest name.
  static TruthKinds parse(const std::string& list);
};

}  // namespace softscope
