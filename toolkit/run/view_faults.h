// toolkit/run/view_faults.h: causes of missing depth that can be measured in the images of a frame.
#pragma once

#include <string>

#include "core/frame.h"
#include "core/stereo_rig.h"
#include "io/sequences/frame_names.h"
#include "io/sequences/sequence_paths.h"

namespace softscope {

/// Where the frames of a sequence come from.
struct ViewOrigin {
  const StereoCalibration& calibration;
  const SequencePaths& paths;
  bool right_first = false;  // in images with both views
};

/// "; " between the causes that apply; empty if none does, or without two views. Brightness of both
/// views, the mask, exchanged views, an ignored orientation tag. Takes as long as the rectification
/// and row alignment of two pairs: for frames without depth only.
std::string viewFaults(const Frame& frame, const FrameNames& names, const ViewOrigin& source);

/// Of these, those that a single frame may have: mask and brightness.
std::string frameFaults(const Frame& frame);

/// The cause in a mask that hides nearly everything, else empty.
std::string maskFault(const Mask& mask);

}  // namespace softscope
