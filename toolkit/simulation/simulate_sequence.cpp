// toolkit/simulation/simulate_sequence.cpp: inputs, frames, truth.
#include "toolkit/simulation/simulate_sequence.h"

#include "eval/simulation/simulator.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/setting_json.h"
#include "toolkit/record/version.h"
#include "toolkit/simulation/simulate_inputs.h"
#include "toolkit/simulation/simulate_outputs.h"

namespace softscope {
namespace {

std::string recordOf(SimulateOptions& options) {
  FactSheet::Json json{
      {"schema_version", 1}, {"softscope", versionText()}, {"command", "simulate"}};
  for (const SettingInfo& setting : settingsOf(options).list())
    json["options"][setting.key] = valueOf(setting);
  return jsonText(json);
}

/// How many frames were added.
int addFrames(const SimulateOptions& options, const Progress& progress, Simulator& simulator,
              SimulateOutputs& outputs) {
  for (int i = 0; i < options.frames; ++i) {
    if (!goesOn(progress, i, options.frames)) return i;
    const bool with_truth = i % options.truth_every == 0 || i + 1 == options.frames;
    outputs.addFrame(i, simulator.frame(i, outputs.wantsFlow() && with_truth),
                     simulator.triangles(), with_truth);
  }
  goesOn(progress, options.frames, options.frames);
  return options.frames;
}

}  // namespace

SimulatedSequence simulateSequence(SimulateOptions options, const TruthKinds& truth,
                                   const std::filesystem::path& out, bool overwrite,
                                   const WorkListener& listener) {
  options.validate();
  readTexture(options);
  OrganFile organ = readOrgan(options);
  for (const std::string& warning : organ.warnings) listener.warn(warning);
  Simulator simulator(std::move(organ.mesh), options.simulation);
  SimulateOutputs outputs({out, truth, options.pictures, options.simulation.frames_per_second,
                           options.jpeg_quality, options.masks, options.input_depth, overwrite},
                          recordOf(options));
  const int frames = addFrames(options, listener.progress, simulator, outputs);
  if (frames > 0) outputs.finish(simulator);
  const PinholeCamera& left = simulator.rig().left;
  return {frames, left.width_px, left.height_px, static_cast<int>(simulator.trackPoints().size())};
}

}  // namespace softscope
