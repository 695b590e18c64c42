// toolkit/face/reconstructor.cpp: of include/softscope/reconstructor.h.
#include "softscope/reconstructor.h"

#include <optional>

#include "pipeline/backends.h"
#include "pipeline/reconstructor.h"
#include "toolkit/face/calibration_data.h"
#include "toolkit/face/image_copies.h"
#include "toolkit/face/model_copy.h"
#include "toolkit/face/run_options_of.h"
#include "toolkit/run/run_folder.h"
#include "toolkit/run/run_record.h"
#include "toolkit/run/run_tables.h"

namespace softscope::api {
namespace {

FrameReport reportOf(const FrameRecord& record) {
  FrameReport report;
  report.frame = record.frame;
  report.status = toString(record.status);
  report.reason = record.reason;
  report.fused = record.fused();
  report.world_from_left = poseOf(record.world_from_left);
  report.coverage = record.depth.coverage();
  report.matches = record.matches.matches;
  report.points = record.points;
  report.elapsed_ms = record.elapsed_ms();
  return report;
}

}  // namespace

struct Reconstructor::Impl {
  Impl(const Calibration& given, const Options& chosen, const std::string& backend)
      : calibration(sized(given.data().calibration)),
        options(runOptionsOf(chosen)),
        loop(makeBackend(backend, calibration, options.method).part, options.method) {}

  StereoCalibration calibration;
  RunOptions options;
  softscope::Reconstructor loop;
  int frames = 0;
  std::string out;
  std::optional<RunFolder> folder;
  std::optional<RunRecord> record;

  void write(const FrameRecord& frame) {
    folder->add(frame);
    record->add(asTabled(frame));
    if (folder->savesModel(frame.frame) && !loop.backend().empty())
      folder->saveModel(frame.frame, frame.time_s, loop.model());
  }
};

Reconstructor::Reconstructor(const Calibration& calibration, const Options& options,
                             const std::string& backend)
    : impl_(std::make_unique<Impl>(calibration, options, backend)) {}
Reconstructor::~Reconstructor() = default;
Reconstructor::Reconstructor(Reconstructor&&) noexcept = default;
Reconstructor& Reconstructor::operator=(Reconstructor&&) noexcept = default;

void Reconstructor::recordTo(const std::string& folder, int save_every, bool overwrite) {
  require(impl_->frames == 0, "recordTo()", "called late", "it comes before the first frame");
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

FrameReport Reconstructor::process(const FrameView& view) {
  const FrameRecord record = impl_->loop.process(frameOf(view, impl_->calibration, impl_->frames));
  ++impl_->frames;
  if (impl_->folder) impl_->write(record);
  return reportOf(record);
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
  impl_->folder->flush({"", impl_->frames, impl_->loop.state()});
  impl_->folder->writeRecord(impl_->record->json(), /*complete=*/true);
  impl_->folder.reset();
  return Run(impl_->out);
}

}  // namespace softscope::api
