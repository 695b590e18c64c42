#include "stereo/options/stereo_options.h"

#include "core/error.h"
#include "stereo/options/stereo_settings.h"

namespace softscope {

void StereoOptions::validate() const {
  requireAllowed(*this);
  require(disparity_max_px == 0 || disparity_max_px > disparity_min_px, "stereo.disparity_max_px",
          disparity_max_px, "must be above stereo.disparity_min_px");
  require(method == "onnx" || model.empty(), "stereo.model", model,
          "belongs to stereo.method=onnx, which is " + method);
  require(method != "onnx" || !model.empty(), "stereo.method", method,
          "needs a network: stereo.model=FILE.onnx");
}

}  // namespace softscope
