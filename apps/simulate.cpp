// apps/simulate.cpp: `softscope simulate`: stereo sequence with ground truth.
#include <spdlog/spdlog.h>

#include <chrono>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "toolkit/simulation/simulate_sequence.h"

namespace softscope {
namespace {

const char* const kSimulateDetails =
    "Writes a sequence folder: left/, right/, calibration.yaml, timestamps.txt, track_points.csv,\n"
    "groundtruth/ with mesh/ and depth/ of every 5th frame, trajectory.txt and tracks.csv (world "
    "=\n"
    "left camera at the first frame, mm), and simulation.json with every setting.\n"
    "The same settings and seed give the same bytes on any number of threads, except of videos.\n"
    "Keys of a scenario: frames, seed, truth_every, pictures, organ.*, texture.*, breathing.*,\n"
    "heartbeat.*, push.*, cut.*, scope.*, camera.*, instrument.*, smoke, event.*,\n"
    "light.*, sensor.*; data/scenario.toml lists all of them.\n"
    "--layout writes one clip with its truth in the layout of a data set (docs/datasets.md).\n"
    "--frames, --size, --seed, --organ and --texture override --set, --set overrides --scenario.";

class SimulateCommand : public Command {
 public:
  std::string name() const override { return "simulate"; }
  std::string summary() const override {
    return "stereo sequence with exact ground truth from an organ";
  }
  std::string details() const override { return kSimulateDetails; }
  std::string example() const override {
    return "softscope simulate --out phantom --frames 40 --size 640x480 --seed 3";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  SimulateOptions readOptions() const;
  void report(const SimulatedSequence& made, double elapsed_s) const;

  std::string out_, scenario_, organ_, texture_, size_, frames_, seed_, truth_, layout_;
  std::vector<std::string> assignments_;
  bool force_ = false;
};

void SimulateCommand::declare(ArgumentList& arguments) {
  arguments.option("--out", "DIR", out_, "folder for the sequence", true);
  arguments.option("--scenario", "FILE", scenario_, "settings file (TOML)");
  arguments.option("--set", "KEY=VALUE", assignments_,
                   "one setting, e.g. push.amplitude_mm=3; repeatable");
  arguments.option("--organ", "FILE", organ_, "closed mesh in mm (STL, PLY, OBJ, VTP), or builtin");
  arguments.option("--texture", "PICTURE", texture_,
                   "image of tissue (PNG, JPEG, TIFF …); default: procedural tissue");
  arguments.option("--frames", "N", frames_, "number of frames (default 40)");
  arguments.option("--size", "WxH", size_, "of the images (default 640x480)");
  arguments.option("--seed", "S", seed_, "of all random numbers (default 1)");
  arguments.option("--truth", "LIST", truth_,
                   "some of mesh,depth,trajectory,tracks (the default), normals,flow; or none");
  arguments.option("--layout", "NAME", layout_,
                   "one clip in the layout of a data set: stir2026, surgt, scared, servct, "
                   "stereomis, d4d, stir, hamlyn or c3vd");
  arguments.flag("--force", force_, "overwrite an earlier simulation");
}

/// Short options are settings too, for one common check and record.
SimulateOptions SimulateCommand::readOptions() const {
  SimulateOptions options;
  Settings settings;
  if (!scenario_.empty()) settings = readSettings(scenario_);
  for (const std::string& assignment : assignments_) addAssignment(settings, assignment);
  if (!frames_.empty()) addAssignment(settings, "frames=" + frames_, "--frames");
  if (!seed_.empty()) addAssignment(settings, "seed=" + seed_, "--seed");
  settingsOf(options).apply(settings);
  if (!organ_.empty()) options.organ = organ_;
  if (!texture_.empty()) options.texture = texture_;
  if (!size_.empty()) setPictureSize(size_, options.simulation.scope);
  return options;
}

int SimulateCommand::run() {
  const InterruptGuard interrupt;
  const SimulateOptions options = readOptions();
  WorkProgress progress("simulate", progressStyle(common.quiet), interrupt);
  const auto start = std::chrono::steady_clock::now();
  const TruthKinds truth = TruthKinds::parse(truth_);
  if (!layout_.empty()) {
    require(truth_.empty(), "--truth", truth_,
            "cannot be combined with --layout, which defines the truth");
    require(!force_, "--force", "given", "--layout overwrites nothing; choose a new folder");
  }
  const SimulatedSequence made =
      layout_.empty() ? simulateSequence(options, truth, out_, force_, listenerOf(progress))
                      : simulateLayout(options, layout_, out_, listenerOf(progress));
  if (made.interrupted) spdlog::warn("interrupted: a sequence of {} frames is kept", made.frames);
  if (made.frames == 0) return kInterrupted;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  report(made, elapsed.count());
  return made.interrupted ? kInterrupted : kDone;
}

void SimulateCommand::report(const SimulatedSequence& made, double elapsed_s) const {
  FactSheet facts("simulated sequence");
  facts.add("folder", "folder", out_);
  facts.add("frames", "frames", made.frames);
  facts.add("picture",
            std::to_string(made.width_px) + " x " + std::to_string(made.height_px) + " px",
            "picture_px", {made.width_px, made.height_px});
  facts.add("tracked points", "tracked_points", made.tracked_points);
  facts.add("time", fixed(elapsed_s, 1) + " s", "elapsed_s", elapsed_s);
  printFacts(facts, common.json);
}

}  // namespace

std::unique_ptr<Command> makeSimulateCommand() { return std::make_unique<SimulateCommand>(); }

}  // namespace softscope
