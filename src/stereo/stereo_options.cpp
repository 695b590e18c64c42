#include "stereo/stereo_options.h"

#include "core/error.h"
#include "stereo/stereo_settings.h"

namespace softscope {

void StereoOptions::validate() const {
  requireAllowed(*this);
  require(disparity_max_px > disparity_min_px, "stereo.disparity_max_px", disparity_max_px,
          "must be above stereo.disparity_min_px");
  require(sgbm_block_px % 2 == 1, "stereo.sgbm_block_px", sgbm_block_px, "must be odd");
  require(smoothing.block_px == 0 || smoothing.block_px >= SmoothingOptions::kSmallestBlockPx,
          "stereo.smoothing.block_px", smoothing.block_px, "must be 0 or at least 4");
}

}  // namespace softscope
