#include "stereo/matching/stereo_matcher.h"

#include <sstream>

#include "core/error.h"
#include "stereo/matching/elas_matcher.h"
#include "stereo/matching/onnx_matcher.h"
#include "stereo/matching/sgbm_matcher.h"

namespace softscope {

void requireRectifiedPair(const GrayImage& left, const GrayImage& right) {
  if (left.sameShape(right) && left.width_px >= kSmallestPicturePx &&
      left.height_px >= kSmallestPicturePx)
    return;
  std::ostringstream text;
  text << "the left image is " << left.width_px << " x " << left.height_px << " pixels, the right "
       << right.width_px << " x " << right.height_px
       << ", but stereo needs two images of one size, " << kSmallestPicturePx
       << " pixels or more each way";
  throw InputError(text.str());
}

std::unique_ptr<StereoMatcher> makeStereoMatcher(const StereoOptions& options) {
  options.validate();
  if (options.method == "sgbm") return std::make_unique<SgbmMatcher>(options);
  if (options.method == "onnx") return std::make_unique<OnnxMatcher>(options);
  return std::make_unique<ElasMatcher>(options);
}

}  // namespace softscope
