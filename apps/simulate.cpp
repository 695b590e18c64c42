// apps/simulate.cpp: `softscope simulate`: a stereo sequence whose truth is known.
#include <spdlog/spdlog.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <optional>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "apps/result_output.h"
#include "core/error.h"
#include "eval/simulation/simulator.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/setting_json.h"
#include "toolkit/record/version.h"
#include "toolkit/simulation/dataset_layout.h"
#include "toolkit/simulation/simulate_inputs.h"
#include "toolkit/simulation/simulate_options.h"
#include "toolkit/simulation/simulate_outputs.h"

namespace softscope {
namespace {

const char* const kDetails =
    "Writes a sequence folder: left/, right/, calibration.yaml, timestamps.txt, track_points.csv,\n"
    "groundtruth/ with mesh/ and depth/ of every 5th frame, trajectory.txt and tracks.csv (world "
    "=\n"
    "the left camera at the first frame, mm), and simulation.json with every setting.\n"
    "The same settings and seed give the same bytes on any number of threads.\n"
    "Keys of a scenario: frames, seed, truth_every, pictures, organ.*, texture.*, breathing.*,\n"
    "heartbeat.*, push.*, cut.*, scope.*, camera.*, instrument.*, smoke, event.*,\n"
    "light.*, sensor.*;\n"
    "data/scenario.toml has them all.\n"
    "--layout writes one clip with its truth as a data set ships it (docs/datasets.md).\n"
    "--frames, --size, --seed, --organ and --texture are stronger than --set, --set than "
    "--scenario.";

class SimulateCommand : public Command {
 public:
  std::string name() const override { return "simulate"; }
  std::string summary() const override {
    return "an organ to a stereo sequence with exact ground truth";
  }
  std::string details() const override { return kDetails; }
  std::string example() const override {
    return "softscope simulate --out phantom --frames 40 --size 640x480 --seed 3";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  void readOptions(SettingsBinder& binder, SimulateOptions& options);
  FactSheet::Json record(const SettingsBinder& binder) const;
  using AddFrame = std::function<void(int index)>;
  int simulateAll(int frames, const AddFrame& add);
  int writeSequence(Simulator& simulator, SimulateOptions& options, const SettingsBinder& binder);
  int writeLayout(Simulator& simulator, SimulateOptions& options);
  void report(const Simulator& simulator, int frames, double elapsed_s) const;

  std::string out_, scenario_, organ_, texture_, size_, frames_, seed_, truth_, layout_;
  std::vector<std::string> assignments_;
  bool force_ = false;
  std::optional<InterruptGuard> interrupt_;
};

void SimulateCommand::declare(ArgumentList& arguments) {
  arguments.option("--out", "DIR", out_, "folder for the sequence", true);
  arguments.option("--scenario", "FILE", scenario_, "settings file (TOML)");
  arguments.option("--set", "KEY=VALUE", assignments_,
                   "one setting, e.g. push.amplitude_mm=3; repeatable");
  arguments.option("--organ", "FILE", organ_, "closed mesh in mm (STL, PLY, OBJ, VTP), or builtin");
  arguments.option("--texture", "PICTURE", texture_,
                   "photograph of tissue (PNG, JPEG, TIFF …); left out: procedural tissue");
  arguments.option("--frames", "N", frames_, "how many (default 40)");
  arguments.option("--size", "WxH", size_, "of the pictures (default 640x480)");
  arguments.option("--seed", "S", seed_, "of everything that chance decides (default 1)");
  arguments.option("--truth", "LIST", truth_,
                   "some of mesh,depth,trajectory,tracks (the default), normals,flow; or none");
  arguments.option("--layout", "NAME", layout_,
                   "one clip as a data set ships it: stir2026, surgt or scared");
  arguments.flag("--force", force_, "overwrite an earlier simulation");
}

/// The short options are settings too, so that one check and one record serve all.
void SimulateCommand::readOptions(SettingsBinder& binder, SimulateOptions& options) {
  Settings settings;
  if (!scenario_.empty()) settings = readSettings(scenario_);
  for (const std::string& assignment : assignments_) addAssignment(settings, assignment);
  if (!frames_.empty()) addAssignment(settings, "frames=" + frames_);
  if (!seed_.empty()) addAssignment(settings, "seed=" + seed_);
  binder = settingsOf(options);
  binder.apply(settings);
  if (!organ_.empty()) options.organ = organ_;
  if (!texture_.empty()) options.texture = texture_;
  if (!size_.empty()) setPictureSize(size_, options.simulation.scope);
  options.validate();
  readTexture(options);
}

FactSheet::Json SimulateCommand::record(const SettingsBinder& binder) const {
  FactSheet::Json json{
      {"schema_version", 1}, {"softscope", versionText()}, {"command", "simulate"}};
  for (const SettingInfo& setting : binder.list()) json["options"][setting.key] = valueOf(setting);
  return json;
}

int SimulateCommand::run() {
  interrupt_.emplace();
  SimulateOptions options;
  SettingsBinder binder;
  readOptions(binder, options);
  TruthKinds::parse(truth_);  // before work begins
  OrganFile organ = readOrgan(options);
  for (const std::string& warning : organ.warnings) spdlog::warn("{}", warning);
  Simulator simulator(std::move(organ.mesh), options.simulation);
  const auto start = std::chrono::steady_clock::now();
  const int done =
      layout_.empty() ? writeSequence(simulator, options, binder) : writeLayout(simulator, options);
  if (done == 0) return kInterrupted;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  report(simulator, done, elapsed.count());
  return done < options.frames ? kInterrupted : kDone;
}

int SimulateCommand::writeSequence(Simulator& simulator, SimulateOptions& options,
                                   const SettingsBinder& binder) {
  SimulateOutputs outputs(
      {out_, TruthKinds::parse(truth_), options.pictures, options.simulation.frames_per_second,
       options.jpeg_quality, options.masks, options.input_depth, force_},
      jsonText(record(binder)));
  const int done = simulateAll(options.frames, [&](int i) {
    const bool with_truth = i % options.truth_every == 0 || i + 1 == options.frames;
    outputs.addFrame(i, simulator.frame(i, outputs.wantsFlow() && with_truth),
                     simulator.triangles(), with_truth);
  });
  if (done > 0) outputs.finish(simulator);
  return done;
}

int SimulateCommand::writeLayout(Simulator& simulator, SimulateOptions& options) {
  require(truth_.empty(), "--truth", truth_, "is not chosen with --layout: the form has its own");
  require(!force_, "--force", "given", "nothing is overwritten with --layout; choose a new folder");
  const auto layout = makeDatasetLayout(layout_, out_, options);
  options.frames = layout->frameCount(options.frames);
  const int done = simulateAll(options.frames,
                               [&](int i) { layout->addFrame(i, simulator.frame(i), simulator); });
  if (done > 0) layout->finish(simulator);
  return done;
}

int SimulateCommand::simulateAll(int frames, const AddFrame& add) {
  ProgressBar progress("simulate", frames, progressStyle(common.quiet), std::cerr);
  for (int i = 0; i < frames; ++i) {
    if (interrupt_->requested()) {
      spdlog::warn("interrupted: a sequence of {} frames stays", i);
      return i;
    }
    add(i);
    progress.advance();
  }
  return frames;
}

void SimulateCommand::report(const Simulator& simulator, int frames, double elapsed_s) const {
  FactSheet facts("simulated sequence");
  facts.add("folder", "folder", out_);
  facts.add("frames", "frames", frames);
  facts.add("picture",
            std::to_string(simulator.rig().left.width_px) + " x " +
                std::to_string(simulator.rig().left.height_px) + " px",
            "picture_px", {simulator.rig().left.width_px, simulator.rig().left.height_px});
  facts.add("tracked points", "tracked_points", static_cast<int>(simulator.trackPoints().size()));
  facts.add("time", fixed(elapsed_s, 1) + " s", "elapsed_s", elapsed_s);
  printFacts(facts, common.json);
}

}  // namespace

std::unique_ptr<Command> makeSimulateCommand() { return std::make_unique<SimulateCommand>(); }

}  // namespace softscope
