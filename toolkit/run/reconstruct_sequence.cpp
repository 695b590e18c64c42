// toolkit/run/reconstruct_sequence.cpp: loop over the frames, with checkpoints.
#include "toolkit/run/reconstruct_sequence.h"

#include <optional>

#include "core/error.h"
#include "io/files/file_hash.h"
#include "io/geometry/track_points_file.h"
#include "io/sequences/frame_window.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "pipeline/backends.h"
#include "pipeline/reconstructor.h"
#include "toolkit/run/out_folder.h"
#include "toolkit/run/repeated_warnings.h"
#include "toolkit/run/run_reader.h"
#include "toolkit/run/run_record.h"
#include "toolkit/run/sequence_frame.h"
#include "toolkit/run/stereo_sync.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

constexpr const char* kOutcomes = "outcomes";  // part of the record for metrics without path

/// Hash of all inputs and settings that determine the result; a resumed run must have the same.
std::string digestOf(const Json& inputs, const std::vector<SettingInfo>& settings,
                     const FrameRange& frames) {
  std::string all;
  if (frames.step != 1) all += "frame_step=" + std::to_string(frames.step) + "\n";
  if (frames.hold_out_every != 0)
    all += "hold_out_every=" + std::to_string(frames.hold_out_every) + "\n";
  for (const SettingInfo& setting : settings)
    all += setting.key + "=" + setting.current_text + "\n";
  for (const auto& [part, input] : inputs.items())
    all += part + "=" + input["sha256"].get<std::string>() + "\n";
  return sha256OfBytes(all);
}

std::vector<TrackSeed> seedsOf(const std::vector<TrackPixel>& pixels) {
  std::vector<TrackSeed> seeds;
  for (const TrackPixel& pixel : pixels) seeds.push_back({pixel.id, pixel.u_px, pixel.v_px});
  return seeds;
}

class SequenceRun {
 public:
  SequenceRun(ReconstructOptions options, const WorkListener& listener)
      : options_(std::move(options)),
        listener_(listener),
        rejections_([&listener](const std::string& text) { listener.warn(text); }) {}

  ReconstructedRun run();

 private:
  std::optional<Checkpoint> earlierState(const RunFolder& folder,
                                         const std::string& settings) const;
  void skipDone(const Checkpoint& earlier);
  std::unique_ptr<ReconstructionBackend> backendOf(const StereoCalibration& calibration) const;
  void reconstructAll(const SequenceReader& reader, FrameWindow& frames,
                      Reconstructor& reconstructor, RunFolder& folder, RunRecord& record,
                      const std::string& digest, int next_frame);
  ReconstructedRun finish(bool nothing, RunFolder& folder, RunRecord& record) const;

  ReconstructOptions options_;
  const WorkListener& listener_;
  RepeatedWarnings rejections_;  // of rejected frames, by status
  bool interrupted_ = false, all_done_ = false, input_gone_ = false;
  std::string failure_;  // failure of the back end during the run
};

/// State of an interrupted run; none for a new run. Throws OptionError.
std::optional<Checkpoint> SequenceRun::earlierState(const RunFolder& folder,
                                                    const std::string& settings) const {
  if (!options_.resume) return std::nullopt;
  const std::string out = options_.out.string();
  std::optional<Checkpoint> earlier = folder.readCheckpoint();
  if (!earlier && !folder.wasKilled())
    throw OptionError("`resume=`: " + out +
                      " holds no interrupted run; start it without `resume=`");
  if (!earlier)
    listener_.warn("the run in " + out +
                   " was killed before its first checkpoint: it starts from the first frame");
  if (earlier && earlier->settings != settings)
    throw OptionError("`resume=`: the run in " + out +
                      " was started with other settings, images, calibration or tracked pixels; "
                      "give the same, or start again without `resume=`");
  return earlier;
}

std::unique_ptr<ReconstructionBackend> SequenceRun::backendOf(
    const StereoCalibration& calibration) const {
  auto chosen = makeBackend(options_.backend, calibration, options_.settings.method);
  if (!chosen.why.empty()) listener_.tell("back end: " + chosen.name + " (" + chosen.why + ")");
  return std::move(chosen.part);
}

/// No frame remains if the run was interrupted between its last frame and its record.
void SequenceRun::skipDone(const Checkpoint& earlier) {
  SequenceOptions& sequence = options_.settings.sequence;
  FrameRange done = sequence.frames;
  done.end = earlier.next_frame;
  all_done_ = done.count() >= SequenceReader(options_.sequence, sequence).frameCount();
  if (!all_done_) sequence.frames.begin = earlier.next_frame;
}

ReconstructedRun SequenceRun::run() {
  options_.validate();
  const std::vector<TrackPixel> tracked =
      options_.tracks.empty() ? std::vector<TrackPixel>() : readTrackPixels(options_.tracks);
  requireOutside(options_.out, options_.sequence);
  SequenceOptions& sequence = options_.settings.sequence;
  RunFolder folder({options_.out, options_.save_every, sequence.frames, !tracked.empty(),
                    options_.overwrite, options_.checkpoint_every},
                   options_.resume);
  const ReconstructionOptions& method = options_.settings.method;
  const ViewRelation views = relateViews(options_.sequence, method.depth, sequence);
  for (const std::string& warning : views.warnings) listener_.warn(warning);
  const Json inputs = inputsJson(options_.sequence, method.depth.stereo.model, options_.tracks);
  const SettingsBinder binder = settingsOf(options_.settings);
  const std::string digest = digestOf(inputs, binder.list(), sequence.frames);
  const std::optional<Checkpoint> earlier = earlierState(folder, digest);
  const int first_frame = earlier ? earlier->next_frame : sequence.frames.begin;
  if (earlier) skipDone(*earlier);

  SequenceReader reader(options_.sequence, sequence);
  reader.expectRows(views.rows);
  FrameWindow frames(reader);
  for (const std::string& warning : reader.calibration().warnings) listener_.warn(warning);
  const PinholeCamera& left = reader.calibration().left.pinhole;
  const std::string outside =
      outsideWarning(tracked, left.width_px, left.height_px, shown(options_.tracks));
  if (!outside.empty()) listener_.warn(outside);
  Reconstructor reconstructor(backendOf(reader.calibration()), method);
  reconstructor.track(seedsOf(tracked));
  folder.tellCamera(reconstructor.backend().rig().left);
  RunRecord record(inputs, reader.calibration(), reconstructor.backend(), binder.list());
  for (const std::string& warning : views.warnings) record.addWarning(warning);
  if (!options_.command_line.empty()) record.set("command_line", options_.command_line);
  if (sequence.frames.hold_out_every > 0) record.set(kHoldOutKey, sequence.frames.hold_out_every);
  checkThresholds(options_.thresholds, record.json(), kOutcomes);  // reports errors before the work
  if (earlier) {
    folder.takeOver(earlier->next_frame);
    reconstructor.restore(earlier->state);
    record.set("resumed_at_frame", earlier->next_frame);
    for (const FrameRecord& frame : folder.earlierFrames()) record.add(frame);
  }
  reconstructAll(reader, frames, reconstructor, folder, record, digest, first_frame);
  return finish(reconstructor.backend().empty(), folder, record);
}

void SequenceRun::reconstructAll(const SequenceReader& reader, FrameWindow& frames,
                                 Reconstructor& reconstructor, RunFolder& folder, RunRecord& record,
                                 const std::string& digest, int next_frame) {
  const int frame_count = reader.frameCount();
  const ViewOrigin views{reader.calibration(), options_.sequence,
                         options_.settings.sequence.right_first};
  int processed = 0;
  bool at_end = all_done_;
  bool wanted = reportProgress(listener_.progress, 0, frame_count);
  while (wanted && !at_end) {
    const FrameResult* result = frames.advance();
    if (result == nullptr) break;
    input_gone_ = wasDeleted(*result, options_.sequence);
    if (input_gone_) break;
    FrameRecord frame;
    try {
      frame = processFrame(*result, frames, views, reconstructor);
    } catch (const BackendError& error) {
      failure_ = error.what();
      break;
    }
    if (!frame.reason.empty())
      rejections_.add(toString(frame.status), frame.frame,
                      say(toString(frame.status), ": ", frame.reason));
    if (result->repeats) record.addRepeated();
    record.addView(frames.current(), frame, reconstructor.backend().rig());
    recordFrame(frame, result->names, reconstructor, folder, record);
    next_frame = frame.frame + options_.settings.sequence.frames.step;
    at_end = ++processed == frame_count;
    if (folder.needsFlush() && !reconstructor.backend().empty())
      folder.flush({digest, next_frame, reconstructor.state()});
    wanted = reportProgress(listener_.progress, processed, frame_count);
  }
  const bool nothing = reconstructor.backend().empty();  // then no run folder is written
  rejections_.conclude(nothing ? "" : "reasons: frames.csv");
  interrupted_ = (!wanted || input_gone_ || !failure_.empty()) && !at_end;
  if (interrupted_ && !input_gone_ && failure_.empty())
    listener_.warn(nothing ? "interrupted before the first model: nothing is written"
                           : "interrupted: finished results are kept; `resume=` continues");
  if (nothing) return;
  if (!interrupted_) folder.saveLastModel(reconstructor.model());
  folder.flush({digest, next_frame, reconstructor.state()});  // resumable until run.json is written
}

ReconstructedRun SequenceRun::finish(bool nothing, RunFolder& folder, RunRecord& record) const {
  record.set("interrupted", interrupted_);
  if (nothing && !interrupted_)
    throw InputError(options_.name +
                     ": no frame could be used, so no run folder was written; the warnings name "
                     "the frames and the reasons; `softscope info` checks the sequence");
  if (!nothing)
    for (const std::string& conclusion : record.conclusions()) listener_.warn(conclusion);
  Json all = record.json();
  const auto outcomes = checkThresholds(options_.thresholds, all, kOutcomes);
  if (!outcomes.empty()) all["thresholds"] = thresholdsJson(outcomes);
  const Json written = options_.paths.applyTo(all);
  if (!nothing) folder.writeRecord(written, record.overlay(), /*complete=*/!interrupted_);
  if (!failure_.empty())
    throw BackendError(failure_ + (nothing
                                       ? ". `backend=` cpu needs no GPU"
                                       : ". Finished results are kept; continue with `resume=`, "
                                         "without the GPU with `resume=` and `backend=` cpu"));
  if (input_gone_)
    throw InputError(options_.name + ": was removed during the run, or its disk; " +
                     (nothing ? "nothing is written. Put it back and start again"
                              : "finished results are kept. Put it back and continue with "
                                "`resume=`"));
  return {written, record.text(nothing ? "" : options_.out.string()), outcomes, interrupted_};
}

}  // namespace

void ReconstructOptions::validate() const {
  settings.validate();
  requireBackendName(backend);
}

ReconstructedRun reconstructSequence(ReconstructOptions options, const WorkListener& listener) {
  return SequenceRun(std::move(options), listener).run();
}

}  // namespace softscope
