// toolkit/run/stereo_sync.h: relation of the views of a clip, in time and rows.
#pragma once

#include <string>
#include <vector>

#include "core/row_plane.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"
#include "pipeline/options/reconstruction_options.h"

namespace softscope {

struct ViewRelation {
  RowPlane rows;                      // of the rectified views, common to all frames
  std::vector<std::string> warnings;  // views are not synchronous; rows do not correspond
  // Reason of the first frame read for this whose views stand still or are equal; empty if none.
  std::string bad_views;
};

/// For two views, unless depth comes from the files of the sequence: estimates rows, and for
/// sequence.right_offset=auto the offset in time, from the frames after the first requested one,
/// independent of end and step of the range; writes the offset into `options`. Unreadable or
/// unmatched images change nothing: the reconstruction reports them. Throws InputError as the
/// reader does.
ViewRelation relateViews(const SequencePaths& paths, const FrameDepthOptions& depth,
                         SequenceOptions& options);

}  // namespace softscope
