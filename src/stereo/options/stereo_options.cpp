#include "stereo/options/stereo_options.h"

#include "core/error.h"
#include "stereo/options/stereo_settings.h"

namespace softscope {

void StereoOptions::validate() const {
  requireAllowed(*this);
  require(disparity_max_px > disparity_min_px, "stereo.disparity_max_px", disparity_max_px,
          "must be above stereo.disparity_min_px");
}

}  // namespace softscope
