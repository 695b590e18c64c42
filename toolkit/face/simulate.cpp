// toolkit/face/simulate.cpp: implementation of include/softscope/simulate.h.
#include "softscope/simulate.h"

#include "toolkit/simulation/simulate_sequence.h"

namespace softscope::api {

Simulation simulate(const std::string& folder, const SimulationRequest& request) {
  SimulateOptions options;
  Settings settings;
  for (const auto& [key, value] : request.settings) addAssignment(settings, key + "=" + value);
  settingsOf(options).apply(settings);
  options.simulation.scope.width_px = request.width_px;
  options.simulation.scope.height_px = request.height_px;
  WorkListener listener;
  listener.progress = request.progress;
  const SimulatedSequence made =
      simulateSequence(options, TruthKinds{}, folder, request.overwrite, listener);
  return {folder, made.frames, made.tracked_points};
}

}  // namespace softscope::api
