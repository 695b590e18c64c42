// apps/reconstruct.cpp: `softscope reconstruct`: deforming model from a stereo clip.
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

const char* const kDetails =
    "Writes model.ply (the last model: mm, world = the left camera at the first frame),\n"
    "models/NNNNNN.ply and .vtp with models.pvd for ParaView, trajectory.txt (TUM lines,\n"
    "world_from_left), frames.csv (what became of each frame), tracks.csv (with --track), "
    "run.json.\n"
    "A sequence is a folder with left/ and right/ images or videos and calibration.yaml;\n"
    "two videos and a calibration do as well: see the second example.\n"
    "A frame that isn't good enough is skipped and reported, never fused. Ctrl-C ends the run\n"
    "cleanly; --resume goes on from there, with the same result as if it had not been stopped.\n"
    "--fail-if METRIC>LIMIT ends with exit code 1 where that holds: a number of run.json, or per\n"
    "cent of the frames: lost>10%, skipped>5%, fused<80%. A learned stereo network of yours takes\n"
    "the place of ours with --set stereo.method=onnx --set stereo.model=FILE.onnx.";

class ReconstructCommand : public Command {
 public:
  std::string name() const override { return "reconstruct"; }
  std::string summary() const override {
    return "a stereo clip to a live, coloured, deforming model with the scope's pose";
  }
  std::string details() const override { return kDetails; }
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
                   "save the model every N frames (default 10; 0: only the last)");
  arguments.option("--hold-out", "N", hold_out_,
                   "leave frames 1, N+1, 2N+1, … out; `evaluate` draws the model for each");
  arguments.option("--track", "FILE", track_,
                   "follow pixels of the first left image: CSV id,u_px,v_px");
  arguments.option("--backend", "NAME", options_.backend, "auto (the default), cpu or cuda");
  arguments.option("--preset", "NAME", preset_, "default, or paper: the paper's nodes and weights");
  arguments.option("--matcher", "NAME", matcher_, "dense-surf (the default), sift or surf-off");
  arguments.option("--scope", "STATE", scope_, "static or moving, where that is known; else auto");
  arguments.flag("--no-correspondence", no_correspondence_,
                 "matches give the pose, but don't pull the warp");
  arguments.option("--checkpoint-every", "N", options_.checkpoint_every,
                   "bring all files up to date every N frames (default 100)");
  arguments.flag("--resume", options_.resume, "go on with an interrupted run");
  arguments.flag("--force", options_.overwrite, "replace an earlier run");
  arguments.option("--fail-if", "LIMIT", fail_if_,
                   "e.g. lost>10%: then exit code 1, the run stays; repeatable");
  softscope::declare(options_.paths, arguments);
  settings_.declare(arguments);
}

RunOptions ReconstructCommand::readSettings() const {
  RunOptions options = RunOptions::ofPreset(preset_);
  Settings settings = settings_.read();
  if (!matcher_.empty()) addAssignment(settings, "matcher.method=" + matcher_);
  if (!scope_.empty()) addAssignment(settings, "pose.scope=" + scope_);
  if (no_correspondence_) addAssignment(settings, "deform.correspondence_weight=0");
  settingsOf(options).apply(settings);
  source_.applyFrames(options.sequence);
  options.sequence.frames.hold_out_every = hold_out_;
  return options;
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
