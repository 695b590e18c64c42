#include "stereo/stereo_matcher.h"

#include "core/error.h"
#include "stereo/elas_matcher.h"
#include "stereo/sgbm_matcher.h"

namespace softscope {

std::unique_ptr<StereoMatcher> makeStereoMatcher(const StereoOptions& options) {
  options.validate();
  if (options.method == "sgbm") return std::make_unique<SgbmMatcher>(options);
  return std::make_unique<ElasMatcher>(options);
}

}  // namespace softscope
