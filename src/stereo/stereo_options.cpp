#include "stereo/stereo_options.h"

#include "core/error.h"

namespace softscope {

void StereoOptions::validate() const {
  require(method == "elas" || method == "sgbm", "stereo.method", method, "must be elas or sgbm");
  require(disparity_min_px >= 0, "stereo.disparity_min_px", disparity_min_px, "can't be negative");
  require(disparity_max_px > disparity_min_px && disparity_max_px < 1024, "stereo.disparity_max_px",
          disparity_max_px, "must be above disparity_min_px and below 1024");
}

}  // namespace softscope
