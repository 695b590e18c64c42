// toolkit/face/reconstructor.cpp: of include/softscope/reconstructor.h.
#include "softscope/reconstructor.h"

#include <optional>

#include "io/text/message.h"
#include "pipeline/backends.h"
#include "pipeline/reconstructor.h"
#include "toolkit/face/calibration_data.h"
#include "toolkit/face/image_copies.h"
#include "toolkit/face/model_copy.h"
#include "toolkit/face/run_options_of.h"
#include "toolkit/face/sequence_data.h"
#include "toolkit/record/record_paths.h"
#include "toolkit/run/out_folder.h"
#include "toolkit/run/run_folder.h"
#include "toolkit/run/run_record.h"
#include "toolkit/run/sequence_frame.h"

namespace softscope::api {
namespace {

constexpr const char* kNotResumable = "";  // digest that no command has

/// `given`: of the sequence. Those of a reconstruction may have none or the same.
void requireSameSequenceOptions(const Options& chosen, const Options& given) {
  for (const auto& [key, value] : chosen.values()) {
    if (key.rfind("sequence.", 0) != 0) continue;
    const auto found = given.values().find(key);
    if (found == given.values().end() || found->second != value)
      throw OptionError("`" + key + "=` " + value + ": was given to the Reconstructor, but " +
                        (found == given.values().end() ? "not" : found->second) +
                        " to the Sequence, which reads the images; give it the same settings");
  }
}

FrameReport reportOf(const FrameRecord& record) {
  FrameReport report;
  report.frame = record.frame;
  report.status = toString(record.status);
  report.reason = record.reason;
  report.fused = record.fused();
  report.world_from_left = poseOf(record.world_from_left);
  report.map = record.map;
  if (record.join) {
    report.joined_map = record.join->from;
    report.world_from_joined = poseOf(record.join->into_from);
  }
  report.coverage = record.depth.coverage();
  report.confidence = record.confidence();
  report.matches = record.matches.matches;
  report.points = record.points;
  report.elapsed_ms = record.elapsed_ms();
  return report;
}

}  // namespace

struct Reconstructor::Impl {
  Impl(const Calibration& given, const Options& given_options, const std::string& backend)
      : calibration(sized(given.data().calibration)),
        chosen(given_options),
        options(runOptionsOf(chosen)),
        loop(makeBackend(backend, calibration, options.method).part, options.method) {}

  StereoCalibration calibration;
  Options chosen;
  RunOptions options;
  softscope::Reconstructor loop;
  int next_frame = 0;
  std::string out;
  std::optional<RunFolder> folder;
  std::optional<RunRecord> record;
  std::weak_ptr<const Sequence::Impl> sequence;  // of the last frame that had one
  FactSheet::Json inputs;                        // its files with their hashes

  void begin(const std::shared_ptr<const Sequence::Impl>& given);
  FrameReport add(const FrameRecord& frame, const FrameNames& names = {});
  void flush() { folder->flush({kNotResumable, next_frame, loop.state()}); }
};

/// Checks a sequence before its first frame, and adds its files to the record of the run.
void Reconstructor::Impl::begin(const std::shared_ptr<const Sequence::Impl>& given) {
  if (sequence.lock() == given) return;
  requireFit(given->reader.calibration(), calibration);
  requireSameSequenceOptions(chosen, given->chosen);
  if (folder) {
    requireOutside(out, given->paths);
    const FactSheet::Json found = inputsJson(given->paths, options.method.depth.stereo.model);
    if (!inputs.is_null() && found != inputs)
      throw OptionError(
          "sequence: has other files than the frames before; a run has one sequence. "
          "Begin another run with a new Reconstructor");
    inputs = found;
    record->set("inputs", inputs);
    options.sequence = given->options;
    record->setConfiguration(settingsOf(options).list());
  }
  sequence = given;
}

FrameReport Reconstructor::Impl::add(const FrameRecord& frame, const FrameNames& names) {
  next_frame = frame.frame + 1;
  if (folder) {
    recordFrame(frame, names, loop, *folder, *record);
    if (folder->needsFlush() && !loop.backend().empty()) flush();
  }
  return reportOf(frame);
}

Reconstructor::Reconstructor(const Calibration& calibration, const Options& options,
                             const std::string& backend)
    : impl_(std::make_unique<Impl>(calibration, options, backend)) {}
Reconstructor::~Reconstructor() = default;
Reconstructor::Reconstructor(Reconstructor&&) noexcept = default;
Reconstructor& Reconstructor::operator=(Reconstructor&&) noexcept = default;

void Reconstructor::recordTo(const std::string& folder, int save_every, bool overwrite) {
  require(impl_->next_frame == 0, "recordTo()", "called late", "it comes before the first frame");
  RunFolderOptions options;
  options.folder = folder;
  options.save_every = save_every;
  options.overwrite = overwrite;
  impl_->out = folder;
  impl_->folder.emplace(options, /*resume=*/false);
  impl_->folder->tellCamera(impl_->loop.backend().rig().left);
  impl_->record.emplace(FactSheet::Json::object(), impl_->calibration, impl_->loop.backend(),
                        settingsOf(impl_->options).list());
}

std::optional<FrameReport> Reconstructor::process(Sequence& sequence) {
  Sequence::Impl& source = *sequence.impl_;
  impl_->begin(sequence.impl_);
  const FrameResult* current = source.frames.advance();
  if (current == nullptr) return std::nullopt;
  if (current->index < impl_->next_frame)
    throw OptionError(say("sequence: its frame ", current->index, " comes after frame ",
                          impl_->next_frame - 1,
                          " of this run; a run takes each frame once, in their order. Begin "
                          "another run with a new Reconstructor"));
  if (wasDeleted(*current, source.paths))
    throw InputError(current->error +
                     "; the sequence was removed, or its disk. finish() completes "
                     "the run with the frames before");
  const ViewOrigin views{source.reader.calibration(), source.paths, source.options.right_first};
  const FrameRecord found = processFrame(*current, source.frames, views, impl_->loop);
  if (current->repeats && impl_->record) impl_->record->addRepeated();
  if (impl_->record)
    impl_->record->addView(source.frames.current(), found, impl_->loop.backend().rig());
  return impl_->add(found, current->names);
}

FrameReport Reconstructor::process(const FrameView& view) {
  const auto frame = std::make_shared<const softscope::Frame>(
      frameOf(view, impl_->calibration, impl_->next_frame));
  const FrameRecord found = impl_->loop.process(*frame);
  if (impl_->record) impl_->record->addView(frame, found, impl_->loop.backend().rig());
  return impl_->add(found);
}

Model Reconstructor::model() const {
  PointCloud cloud = cloudOf(impl_->loop.model());
  return modelOf(cloud.points_mm, cloud.normals, cloud.colours, cloud.weights,
                 std::move(cloud.sigmas_mm));
}

Run Reconstructor::finish() {
  require(impl_->folder.has_value(), "finish()", "called without a folder",
          "recordTo() names one before the first frame");
  if (impl_->loop.backend().empty())
    throw InputError(impl_->out + ": no frame could be used; see the reason in the reports");
  impl_->folder->saveLastModel(impl_->loop.model());
  impl_->flush();
  impl_->record->set("interrupted", false);
  impl_->folder->writeRecord(RecordPaths().applyTo(impl_->record->json()), impl_->record->overlay(),
                             /*complete=*/true);
  impl_->folder.reset();
  return Run(impl_->out);
}

}  // namespace softscope::api
