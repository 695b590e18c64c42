// include/softscope/simulate.h: simulated stereo sequence with ground truth.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "softscope/error.h"

namespace softscope::api {

struct SimulationRequest {
  std::map<std::string, std::string> settings;  // as in data/scenario.toml: "frames", "seed"
  int width_px = 640, height_px = 480;
  bool overwrite = false;
  std::function<bool(int done, int total)> progress;  // frames; false: stop
};

struct Simulation {
  std::string folder;
  int frames = 0;  // fewer than requested after a stop
  int tracked_points = 0;
};

/// Writes a sequence folder. Deterministic for given
/// settings. Throws OptionError and InputError.
Simulation simulate(const std::string& folder, const SimulationRequest& request = {});

}  // namespace softscope::api
