// apps/reconstruct.cpp: `softscope reconstruct`: deforming model from a stereo clip.
#include <algorithm>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/sequence_arguments.h"
#include "apps/shared_arguments.h"
#include "apps/threshold_exit.h"
#include "apps/work_progress.h"
#include "toolkit/run/reconstruct_sequence.h"

namespace softscope {
namespace {

constexpr const char* kResume = "--resume";
const char* const kReconstructDetails =
    "Writes model.ply (the last model: mm, world = left camera at the first frame),\n"
    "models/NNNNNN.ply and .vtp with models.pvd for ParaView, trajectory.txt (TUM lines,\n"
    "world_from_left), frames.csv (status of each frame), tracks.csv (with --track), run.json.\n"
    "A sequence is a folder with left/ and right/ images or videos and calibration.yaml;\n"
    "two videos and a calibration are accepted too: see the second example.\n"
    "An insufficient frame is skipped and reported, never fused. Ctrl-C ends the run cleanly;\n"
    "--resume continues it, with the same result as without the interruption.\n"
    "--fail-if METRIC>LIMIT ends with exit code 1 if that is true: a number of run.json, or a\n"
    "percentage of the frames: lost>10%, skipped>5%, fused<80%. A custom stereo network:\n"
    "--set stereo.method=onnx --set stereo.model=FILE.onnx.";

class ReconstructCommand : public Command {
 public:
  std::string name() const override { return "reconstruct"; }
  std::string summary() const override {
    return "deforming, coloured model and camera poses from a stereo clip";
  }
  std::string details() const override { return kReconstructDetails; }
  std::string example() const override {
    return "softscope reconstruct clip --out run\n"
           "  softscope reconstruct left.mp4 right.mp4 --calibration calibration.yaml --out run";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  RunOptions readSettings() const;

  SequenceArguments source_;
  SettingsArguments settings_;
  ReconstructOptions options_;
  std::vector<std::string> fail_if_;
  std::string out_, track_, preset_ = "default", matcher_, scope_;
  int hold_out_ = 0;
  bool no_correspondence_ = false;
};

void ReconstructCommand::declare(ArgumentList& arguments) {
  arguments.positional("SEQUENCE", source_.left, "sequence folder; or the left video or folder",
                       true);
  arguments.positional("RIGHT", source_.right, "right video or folder; not for a sequence folder",
                       false);
  arguments.option("--out", "DIR", out_, "folder for the run", true);
  source_.declareOptions(arguments);
  arguments.option("--save-every", "N", options_.save_every,
                   "save the model every N frames (default 10; 0: last only)");
  arguments.option("--hold-out", "N", hold_out_,
                   "hold out frames 1, N+1, 2N+1, …; `evaluate` renders the model for each");
  arguments.option("--track", "FILE", track_,
                   "track pixels of the first left image: CSV id,u_px,v_px");
  arguments.option("--backend", "NAME", options_.backend, "auto (the default), cpu or cuda");
  arguments.option("--preset", "NAME", preset_,
                   "default, or paper: nodes and weights of the paper");
  arguments.option("--matcher", "NAME", matcher_, "dense-surf (the default), sift or surf-off");
  arguments.option("--scope", "STATE", scope_, "static or moving, if known; else auto");
  arguments.flag("--no-correspondence", no_correspondence_,
                 "use matches for the pose, but not for the warp");
  arguments.option("--checkpoint-every", "N", options_.checkpoint_every,
                   "update all files every N frames (default 100)");
  arguments.flag(kResume, options_.resume, "continue an interrupted run");
  arguments.flag("--force", options_.overwrite, "replace an earlier run");
  arguments.option("--fail-if", "LIMIT", fail_if_,
                   "e.g. lost>10%: then exit code 1, the run is kept; repeatable");
  softscope::declare(options_.paths, arguments);
  settings_.declare(arguments);
}

RunOptions ReconstructCommand::readSettings() const {
  RunOptions options = RunOptions::ofPreset(preset_);
  Settings settings = settings_.read();
  if (!matcher_.empty()) addAssignment(settings, "matcher.method=" + matcher_, "--matcher");
  if (!scope_.empty()) addAssignment(settings, "pose.scope=" + scope_, "--scope");
  if (no_correspondence_)
    addAssignment(settings, "deform.correspondence_weight=0", "--no-correspondence");
  settingsOf(options).apply(settings);
  source_.applyFrames(options.sequence);
  options.sequence.frames.hold_out_every = hold_out_;
  return options;
}

/// Of a call that makes the run at once: a resumed run has the same record.
std::vector<std::string> wordsOfTheWhole(std::vector<std::string> words) {
  words.erase(std::remove(words.begin(), words.end(), kResume), words.end());
  return words;
}

int ReconstructCommand::run() {
  const InterruptGuard interrupt;
  for (const std::string& text : fail_if_) options_.thresholds.push_back(parseThreshold(text));
  options_.settings = readSettings();
  options_.validate();
  options_.sequence = source_.paths("reconstruct");
  options_.name = source_.left;
  options_.out = out_;
  options_.tracks = track_;
  options_.command_line = wordsOfTheWhole(words);
  WorkProgress progress("reconstruct", progressStyle(common.quiet), interrupt);
  const ReconstructedRun made = reconstructSequence(options_, listenerOf(progress));
  if (common.json)
    printJson(made.record);
  else
    printFacts(made.facts, false);
  return made.interrupted ? kInterrupted : exitCodeOf(made.outcomes);
}

}  // namespace

std::unique_ptr<Command> makeReconstructCommand() { return std::make_unique<ReconstructCommand>(); }

}  // namespace softscope
