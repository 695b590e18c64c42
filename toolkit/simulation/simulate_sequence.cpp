// toolkit/simulation/simulate_sequence.cpp: inputs, frames and ground truth.
#include "toolkit/simulation/simulate_sequence.h"

#include "eval/simulation/sequence/simulator.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/setting_json.h"
#include "toolkit/record/version.h"
#include "toolkit/simulation/dataset_layout.h"
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

/// Adds frames 0, 1, … `frames` - 1 until `progress` stops. Returns the number of added frames.
template <class Add>
int addFrames(int frames, const Progress& progress, const Add& add) {
  for (int i = 0; i < frames; ++i) {
    if (!reportProgress(progress, i, frames)) return i;
    add(i);
  }
  reportProgress(progress, frames, frames);
  return frames;
}

Simulator simulatorOf(SimulateOptions& options, const WorkListener& listener) {
  options.validate();
  readTexture(options);
  OrganFile organ = readOrgan(options);
  for (const std::string& warning : organ.warnings) listener.warn(warning);
  return Simulator(std::move(organ.mesh), options.simulation);
}

SimulatedSequence madeBy(const Simulator& simulator, int frames, int asked) {
  const PinholeCamera& left = simulator.rig().left;
  return {frames, left.width_px, left.height_px, static_cast<int>(simulator.trackPoints().size()),
          frames < asked};
}

}  // namespace

SimulatedSequence simulateSequence(SimulateOptions options, const TruthKinds& truth,
                                   const std::filesystem::path& out, bool overwrite,
                                   const WorkListener& listener) {
  Simulator simulator = simulatorOf(options, listener);
  SimulateOutputs outputs({out, truth, options.pictures, options.simulation.frames_per_second,
                           options.jpeg_quality, options.masks, options.input_depth, overwrite},
                          recordOf(options));
  const int frames = addFrames(options.frames, listener.progress, [&](int i) {
    const bool with_truth = i % options.truth_every == 0 || i + 1 == options.frames;
    outputs.addFrame(i, simulator.frame(i, outputs.wantsFlow() && with_truth),
                     simulator.triangles(), with_truth);
  });
  if (frames > 0) outputs.finish(simulator);
  return madeBy(simulator, frames, options.frames);
}

SimulatedSequence simulateLayout(SimulateOptions options, const std::string& layout,
                                 const std::filesystem::path& out, const WorkListener& listener) {
  Simulator simulator = simulatorOf(options, listener);
  const auto writer = makeDatasetLayout(layout, out, options);
  const int asked = writer->frameCount(options.frames);
  const int frames = addFrames(asked, listener.progress,
                               [&](int i) { writer->addFrame(i, simulator.frame(i), simulator); });
  if (frames > 0) writer->finish(simulator);
  return madeBy(simulator, frames, asked);
}

}  // namespace softscope
