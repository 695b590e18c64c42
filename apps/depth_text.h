// apps/depth_text.h: words and ranges of `softscope depth`.
#pragma once

#include <string>

#include "vtk_views/plots/depth_picture.h"

namespace softscope {

extern const char* const kDepthDetails;  // for its help

/// "40:80", mm. Throws OptionError.
DepthRange parseDepthRange(const std::string& text);

/// One range for all pictures of a run: of a sequence the first frame's, a tenth wider on either
/// side, since tissue moves.
DepthRange rangeForAll(const DepthRange& first, bool is_sequence);

/// Above the picture: the method, the path's last part, and the frame unless it is negative.
std::string titleOf(const std::string& method, const std::string& path, int frame);

}  // namespace softscope
