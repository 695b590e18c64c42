// toolkit/face/sequence.cpp: implementation of include/softscope/sequence.h.
#include "softscope/sequence.h"

#include "pipeline/options/run_options.h"
#include "toolkit/face/calibration_data.h"
#include "toolkit/face/image_copies.h"
#include "toolkit/face/run_options_of.h"
#include "toolkit/face/sequence_data.h"
#include "toolkit/run/stereo_sync.h"

namespace softscope::api {
namespace {

/// As the command: with the estimated offset between the views.
SequenceOptions optionsOf(const SequencePaths& paths, const Options& chosen, ViewRelation* views) {
  RunOptions options = runOptionsOf(chosen);
  *views = relateViews(paths, options.method.depth, options.sequence);
  return options.sequence;
}

SequencePaths pathsOf(const std::string& left, const std::string& right,
                      const std::string& calibration) {
  SequencePaths paths;
  paths.left = left;
  paths.right = right;
  paths.calibration = calibration;
  return paths;
}

}  // namespace

Sequence::Impl::Impl(SequencePaths opened, const Options& given)
    : paths(std::move(opened)),
      chosen(given),
      options(optionsOf(paths, chosen, &views)),
      reader(paths, options),
      frames(reader) {
  reader.expectRows(views.rows);
}

Sequence::Sequence(const std::string& folder, const Options& options)
    : impl_(std::make_shared<Impl>(findSequence(folder), options)) {}

Sequence::Sequence(const std::string& left, const std::string& right,
                   const std::string& calibration, const Options& options)
    : impl_(std::make_shared<Impl>(pathsOf(left, right, calibration), options)) {}

Sequence::~Sequence() = default;
Sequence::Sequence(Sequence&&) noexcept = default;
Sequence& Sequence::operator=(Sequence&&) noexcept = default;

Calibration Sequence::calibration() const { return calibrationOf(impl_->reader.calibration()); }

int Sequence::frameCount() const { return impl_->reader.frameCount(); }

std::vector<std::string> Sequence::warnings() const {
  std::vector<std::string> all = impl_->reader.calibration().warnings;
  const std::vector<std::string>& of_views = impl_->views.warnings;
  all.insert(all.begin(), of_views.begin(), of_views.end());
  return all;
}

std::optional<Frame> Sequence::next() {
  const FrameResult* result = impl_->frames.advance();
  if (result == nullptr) return std::nullopt;
  Frame frame;
  frame.index = result->index;
  frame.error = result->error;
  if (!result->ok()) return frame;
  frame.time_s = result->frame.time_s;
  frame.left = imageOf(result->frame.pair.left);
  frame.right = imageOf(result->frame.pair.right);
  frame.mask = imageOf(result->frame.mask);
  return frame;
}

}  // namespace softscope::api
