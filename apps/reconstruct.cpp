// apps/reconstruct.cpp: `softscope reconstruct`: a stereo clip to a live, deforming model.
#include <spdlog/spdlog.h>

#include <chrono>
#include <iostream>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "apps/result_output.h"
#include "apps/sequence_arguments.h"
#include "apps/shared_arguments.h"
#include "apps/threshold_exit.h"
#include "core/error.h"
#include "io/file_hash.h"
#include "io/folder.h"
#include "io/frame_window.h"
#include "io/sequence_reader.h"
#include "io/track_points_file.h"
#include "pipeline/backends.h"
#include "pipeline/reconstructor.h"
#include "pipeline/run_options.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/record_paths.h"
#include "toolkit/run/run_folder.h"
#include "toolkit/run/run_record.h"
#include "toolkit/run/run_tables.h"
#include "toolkit/run/stereo_sync.h"

namespace softscope {
namespace {

const char* const kDetails =
    "Writes model.ply (the last model: mm, world = the left camera at the first frame),\n"
    "models/NNNNNN.ply and .vtp with models.pvd for ParaView, trajectory.txt (TUM lines,\n"
    "world_from_left), frames.csv (what became of each frame), tracks.csv (with --track), "
    "run.json.\n"
    "A sequence is a folder with left/ and right/ pictures or videos and calibration.yaml;\n"
    "two videos and a calibration do as well: see the second example.\n"
    "A frame that isn't good enough is skipped and reported, never fused. Ctrl-C ends the run\n"
    "cleanly; --resume goes on from there, with the same result as if it had not been stopped.\n"
    "--fail-if METRIC>LIMIT ends with exit code 1 where that holds: a number of run.json, or per\n"
    "cent of the frames: lost>10%, skipped>5%, fused<80%.";

using Json = FactSheet::Json;

constexpr const char* kPreferred = "outcomes";  // where --fail-if looks for a bare name

/// Whether pictures that the run began with are there no longer.
bool isGone(const SequencePaths& sequence) {
  for (const std::filesystem::path& view : {sequence.left, sequence.right, sequence.stereo})
    if (!view.empty() && !isThere(view)) return true;
  return false;
}

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
  std::string digestOf(const Json& inputs, const SettingsBinder& binder) const;
  std::vector<TrackSeed> seeds() const;
  std::unique_ptr<ReconstructionBackend> backendOf(const StereoCalibration& calibration,
                                                   const ReconstructionOptions& options) const;
  void readOptions(SettingsBinder& binder, RunOptions& options) const;
  /// The state to go on from; nothing for a run that starts. Throws OptionError.
  std::optional<Checkpoint> earlierState(const RunFolder& folder,
                                         const std::string& settings) const;
  void skipDone(const Checkpoint& earlier, const SequencePaths& where, SequenceOptions& sequence);
  void reconstructAll(const SequencePaths& sequence, const InterruptGuard& interrupt,
                      FrameWindow& frames, int frame_count, Reconstructor& reconstructor,
                      RunFolder& folder, RunRecord& record, Checkpoint& checkpoint);
  int finish(bool nothing, RunFolder& folder, RunRecord& record) const;

  SequenceArguments source_;
  std::string out_, track_;
  std::string backend_ = "auto", preset_ = "default", matcher_, scope_;
  int save_every_ = 10, checkpoint_every_ = 100;
  bool no_correspondence_ = false, resume_ = false, force_ = false;
  std::vector<std::string> fail_if_;
  std::vector<Threshold> thresholds_;
  RecordPaths paths_;
  SettingsArguments settings_;
  bool interrupted_ = false, all_done_ = false, input_gone_ = false;
  std::string failure_;  // of the back end in the middle of the run
};

void ReconstructCommand::declare(ArgumentList& arguments) {
  arguments.positional("SEQUENCE", source_.left, "sequence folder; or the left video or folder",
                       true);
  arguments.positional("RIGHT", source_.right, "right video or folder; not for a sequence folder",
                       false);
  arguments.option("--out", "DIR", out_, "folder for the run", true);
  source_.declareOptions(arguments);
  arguments.option("--save-every", "N", save_every_,
                   "save the model every N frames (default 10; 0: only the last)");
  arguments.option("--track", "FILE", track_,
                   "follow pixels of the first left picture: CSV id,u_px,v_px");
  arguments.option("--backend", "NAME", backend_, "auto (the default), cpu or cuda");
  arguments.option("--preset", "NAME", preset_, "default, or paper: the paper's nodes and weights");
  arguments.option("--matcher", "NAME", matcher_, "dense-surf (the default), sift or surf-off");
  arguments.option("--scope", "STATE", scope_, "static or moving, where that is known; else auto");
  arguments.flag("--no-correspondence", no_correspondence_,
                 "matches give the pose, but don't pull the warp");
  arguments.option("--checkpoint-every", "N", checkpoint_every_,
                   "bring all files up to date every N frames (default 100)");
  arguments.flag("--resume", resume_, "go on with an interrupted run");
  arguments.flag("--force", force_, "replace an earlier run");
  arguments.option("--fail-if", "LIMIT", fail_if_,
                   "e.g. lost>10%: then exit code 1, the run stays; repeatable");
  softscope::declare(paths_, arguments);
  settings_.declare(arguments);
}

/// Everything that decides the result; a run goes on only with the same.
std::string ReconstructCommand::digestOf(const Json& inputs, const SettingsBinder& binder) const {
  std::string all;
  for (const SettingInfo& setting : binder.list())
    all += setting.key + "=" + setting.current_text + "\n";
  for (const auto& [part, input] : inputs.items())
    all += part + "=" + input["sha256"].get<std::string>() + "\n";
  if (!track_.empty()) all += sha256Of(track_);
  return sha256OfBytes(all);
}

std::vector<TrackSeed> ReconstructCommand::seeds() const {
  std::vector<TrackSeed> seeds;
  if (track_.empty()) return seeds;
  for (const TrackPixel& pixel : readTrackPixels(track_))
    seeds.push_back({pixel.id, pixel.u_px, pixel.v_px});
  return seeds;
}

std::unique_ptr<ReconstructionBackend> ReconstructCommand::backendOf(
    const StereoCalibration& calibration, const ReconstructionOptions& options) const {
  auto chosen = makeBackend(backend_, calibration, options);
  if (!chosen.why.empty()) spdlog::info("back end: {} ({})", chosen.name, chosen.why);
  return std::move(chosen.part);
}

void ReconstructCommand::readOptions(SettingsBinder& binder, RunOptions& options) const {
  Settings settings = settings_.read();
  if (!matcher_.empty()) addAssignment(settings, "matcher.method=" + matcher_);
  if (!scope_.empty()) addAssignment(settings, "pose.scope=" + scope_);
  if (no_correspondence_) addAssignment(settings, "deform.use_correspondences=false");
  binder.apply(settings);
  source_.applyFrames(options.sequence);
  options.validate();
  require(checkpoint_every_ >= 1, "--checkpoint-every", checkpoint_every_, "must be 1 or more");
}

std::optional<Checkpoint> ReconstructCommand::earlierState(const RunFolder& folder,
                                                           const std::string& settings) const {
  if (!resume_) return std::nullopt;
  std::optional<Checkpoint> earlier = folder.readCheckpoint();
  if (!earlier && !folder.wasKilled())
    throw OptionError("--resume: " + out_ + " holds no interrupted run; start it without --resume");
  if (!earlier)
    spdlog::warn("the run in {} was killed before its first checkpoint: it starts anew", out_);
  if (earlier && earlier->settings != settings)
    throw OptionError(
        "--resume: the run in " + out_ +
        " was begun with other settings, pictures, calibration or tracked pixels; give the "
        "same, or start again without --resume");
  return earlier;
}

/// Where no frame is left, the run was stopped between its last one and its record.
void ReconstructCommand::skipDone(const Checkpoint& earlier, const SequencePaths& where,
                                  SequenceOptions& sequence) {
  const int done = earlier.next_frame - sequence.frames.begin;
  all_done_ = done >= SequenceReader(where, sequence).frameCount();
  if (!all_done_) sequence.frames.begin = earlier.next_frame;
}

int ReconstructCommand::run() {
  const InterruptGuard interrupt;
  for (const std::string& text : fail_if_) thresholds_.push_back(parseThreshold(text));
  RunOptions options = RunOptions::ofPreset(preset_);
  SettingsBinder binder = settingsOf(options);
  readOptions(binder, options);
  const SequencePaths where = source_.paths("reconstruct");
  const std::vector<TrackSeed> tracked = seeds();
  requireOutside(out_, where);
  RunFolder folder({out_, save_every_, !tracked.empty(), force_}, resume_);
  const FrameDepthOptions& depth = options.method.depth;
  if (depth.source == "stereo" || where.depth.empty())
    if (const std::string warning =
            settleRightOffset(where, options.sequence, depth.stereo.disparity_max_px);
        !warning.empty())
      spdlog::warn("{}", warning);
  const Json inputs = inputsJson(where);
  Checkpoint checkpoint{digestOf(inputs, binder), options.sequence.frames.begin, {}};
  const std::optional<Checkpoint> earlier = earlierState(folder, checkpoint.settings);
  if (earlier) {
    checkpoint.next_frame = earlier->next_frame;
    skipDone(*earlier, where, options.sequence);
  }

  SequenceReader reader(where, options.sequence);
  FrameWindow frames(reader);  // outlives the back end, which looks ahead in it
  for (const std::string& warning : reader.calibration().warnings) spdlog::warn("{}", warning);
  Reconstructor reconstructor(backendOf(reader.calibration(), options.method), options.method);
  reconstructor.track(tracked);
  folder.tellCamera(reconstructor.backend().rig().left);
  RunRecord record(inputs, reader.calibration(), reconstructor.backend(), binder.list());
  checkThresholds(thresholds_, record.json(), kPreferred);  // a misspelt name, before the work
  if (earlier) {
    folder.takeOver(earlier->next_frame);
    reconstructor.restore(earlier->state);
    record.set("resumed_at_frame", earlier->next_frame);
    for (const FrameRecord& frame : folder.earlierFrames()) record.add(frame);
  }
  reconstructAll(where, interrupt, frames, reader.frameCount(), reconstructor, folder, record,
                 checkpoint);
  return finish(reconstructor.backend().empty(), folder, record);
}

int ReconstructCommand::finish(bool nothing, RunFolder& folder, RunRecord& record) const {
  record.set("interrupted", interrupted_);
  if (nothing && !interrupted_)
    throw InputError(source_.left + ": not one frame could be used; the reasons stand above");
  for (const std::string& conclusion : record.conclusions()) spdlog::warn("{}", conclusion);
  Json all = record.json();
  const auto outcomes = checkThresholds(thresholds_, all, kPreferred);
  if (!outcomes.empty()) all["thresholds"] = thresholdsJson(outcomes);
  const Json written = paths_.applyTo(all);
  if (!nothing) folder.writeRecord(jsonText(written), /*complete=*/!interrupted_);
  if (!failure_.empty())
    throw BackendError(failure_ + (nothing ? ""
                                           : ". What is finished stays; go on with --resume, "
                                             "without the GPU with --resume --backend cpu"));
  if (input_gone_)
    throw InputError(source_.left +
                     ": was removed while it was read, or its disk; what is finished "
                     "stays. Put it back and go on with --resume");
  if (common.json)
    printJson(written);
  else
    printFacts(record.text(out_), false);
  return interrupted_ ? kInterrupted : exitCodeOf(outcomes);
}

void ReconstructCommand::reconstructAll(const SequencePaths& sequence,
                                        const InterruptGuard& interrupt, FrameWindow& frames,
                                        int frame_count, Reconstructor& reconstructor,
                                        RunFolder& folder, RunRecord& record,
                                        Checkpoint& checkpoint) {
  ProgressBar progress("reconstruct", frame_count, progressStyle(common.quiet), std::cerr);
  int since_flush = 0, processed = 0;
  bool at_end = all_done_;
  while (!interrupt.requested() && !at_end) {
    const FrameResult* result = frames.advance();
    if (result == nullptr) break;
    input_gone_ = !result->ok() && isGone(sequence);
    if (input_gone_) break;
    FrameRecord frame;
    try {
      frame = result->ok() ? reconstructor.process(result->frame, frames.following())
                           : reconstructor.skip(result->index, result->error, result->time_s);
    } catch (const BackendError& error) {
      failure_ = error.what();
      break;
    }
    if (!frame.reason.empty())
      spdlog::warn("frame {}: {}: {}", frame.frame, toString(frame.status), frame.reason);
    folder.add(frame);
    record.add(asTabled(frame));
    if (folder.savesModel(frame.frame) && !reconstructor.backend().empty())
      folder.saveModel(frame.frame, frame.time_s, reconstructor.state().model);
    checkpoint.next_frame = frame.frame + 1;
    at_end = ++processed == frame_count;
    if (++since_flush >= checkpoint_every_ && !reconstructor.backend().empty()) {
      checkpoint.state = reconstructor.state();
      folder.flush(checkpoint);
      since_flush = 0;
    }
    progress.advance();
  }
  interrupted_ = (interrupt.requested() || input_gone_ || !failure_.empty()) && !at_end;
  if (interrupted_ && !input_gone_ && failure_.empty())
    spdlog::warn("interrupted: what is finished stays; --resume goes on");
  if (reconstructor.backend().empty()) return;
  checkpoint.state = reconstructor.state();
  if (!interrupted_) folder.saveLastModel(checkpoint.state.model);
  folder.flush(checkpoint);  // resumable until run.json is there
}

}  // namespace

std::unique_ptr<Command> makeReconstructCommand() { return std::make_unique<ReconstructCommand>(); }

}  // namespace softscope
