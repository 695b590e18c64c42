#include "toolkit/run/sequence_frame.h"

#include "io/files/folder.h"
#include "toolkit/run/run_tables.h"

namespace softscope {
namespace {

constexpr double kLittleDepth = 0.05;  // coverage below which the images are examined

/// Adds the faults of the views to the reason of a frame with little depth. Views that gave a model
/// have no fault of a whole clip.
void explainNoDepth(const FrameResult& current, const ViewOrigin& source, bool has_model,
                    FrameRecord* frame) {
  if (frame->status != FrameStatus::kSkippedDepth || frame->depth.coverage() >= kLittleDepth)
    return;
  const std::string faults =
      has_model ? frameFaults(current.frame) : viewFaults(current.frame, current.names, source);
  if (!faults.empty()) frame->reason += ": " + faults;
}

}  // namespace

bool wasDeleted(const FrameResult& frame, const SequencePaths& sequence) {
  if (frame.ok()) return false;
  for (const std::filesystem::path& view :
       {sequence.left, sequence.right, sequence.stereo, sequence.depth})
    if (!view.empty() && !isThere(view)) return true;
  return false;
}

FrameRecord processFrame(const FrameResult& current, const FrameWindow& frames,
                         const ViewOrigin& source, Reconstructor& reconstructor) {
  if (current.ok()) {
    FrameRecord frame = reconstructor.process(current.frame, frames.upcoming());
    explainNoDepth(current, source, !reconstructor.backend().empty(), &frame);
    return frame;
  }
  return reconstructor.skip(current.index, current.error, current.time_s,
                            current.unpaired ? FrameStatus::kUnpaired : FrameStatus::kUnreadable);
}

void recordFrame(const FrameRecord& frame, const FrameNames& names,
                 const Reconstructor& reconstructor, RunFolder& folder, RunRecord& record) {
  folder.add(frame, names);
  record.add(asTabled(frame));
  if (folder.savesModel(frame.frame) && !reconstructor.backend().empty())
    folder.saveModel(frame.frame, frame.time_s, reconstructor.model());
}

}  // namespace softscope
