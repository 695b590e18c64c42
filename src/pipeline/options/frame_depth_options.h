// src/pipeline/options/frame_depth_options.h: options of stage 1.
#pragma once

#include <string>

#include "stereo/options/stereo_options.h"

namespace softscope {

/// Source of depth.
struct FrameDepthOptions {
  std::string source =
      "auto";               // the sequence's own depth/ where there is one; or "stereo", "files"
  bool align_rows = true;   // remove a residual row error where it is large enough
  bool find_border = true;  // mask even borders of the views
  bool detect_instruments = true;  // and smoke: without red, and apart from the tissue
  StereoOptions stereo;

  /// Throws OptionError.
  void validate() const;
};

}  // namespace softscope
