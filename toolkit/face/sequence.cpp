// toolkit/face/sequence.cpp: implementation of include/softscope/sequence.h.
#include "softscope/sequence.h"

#include "pipeline/run_options.h"
#include "toolkit/face/calibration_data.h"
#include "toolkit/face/image_copies.h"
#include "toolkit/face/sequence_data.h"
#include "toolkit/run/stereo_sync.h"

namespace softscope::api {
namespace {

SequenceReader openSequence(const SequencePaths& paths) {
  RunOptions options;
  estimateRightOffset(paths, options.sequence, options.method.depth.stereo.disparity_max_px);
  return SequenceReader(paths, options.sequence);
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

Sequence::Impl::Impl(SequencePaths opened)
    : paths(std::move(opened)), reader(openSequence(paths)), frames(reader) {}

Sequence::Sequence(const std::string& folder)
    : impl_(std::make_shared<Impl>(findSequence(folder))) {}

Sequence::Sequence(const std::string& left, const std::string& right,
                   const std::string& calibration)
    : impl_(std::make_shared<Impl>(pathsOf(left, right, calibration))) {}

Sequence::~Sequence() = default;
Sequence::Sequence(Sequence&&) noexcept = default;
Sequence& Sequence::operator=(Sequence&&) noexcept = default;

Calibration Sequence::calibration() const { return calibrationOf(impl_->reader.calibration()); }

int Sequence::frameCount() const { return impl_->reader.frameCount(); }

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
