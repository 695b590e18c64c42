// toolkit/run/sequence_frame.h: one frame of a sequence, reconstructed and recorded.
#pragma once

#include "io/sequences/frame_window.h"
#include "io/sequences/sequence_paths.h"
#include "pipeline/reconstructor.h"
#include "toolkit/run/run_folder.h"
#include "toolkit/run/run_record.h"
#include "toolkit/run/view_faults.h"

namespace softscope {

/// True if the frame is unreadable because images of the sequence were deleted during the run.
bool wasDeleted(const FrameResult& frame, const SequencePaths& sequence);

/// Processes the current frame of `frames`; the depth of those that follow starts in parallel.
/// Skips an unreadable frame with its reason; the reason of one without depth has the faults of its
/// views. Throws BackendError.
FrameRecord processFrame(const FrameResult& current, const FrameWindow& frames,
                         const ViewOrigin& source, Reconstructor& reconstructor);

/// Writes the tables' rows of a frame, and the model if it is due. `names` without a left name:
/// images not from files.
void recordFrame(const FrameRecord& frame, const FrameNames& names,
                 const Reconstructor& reconstructor, RunFolder& folder, RunRecord& record);

}  // namespace softscope
