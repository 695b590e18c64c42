#include "stereo/matching/stereo_matcher.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "core/error.h"
#include "stereo/matching/elas_matcher.h"
#include "stereo/matching/onnx_matcher.h"
#include "stereo/matching/sgbm_matcher.h"

namespace softscope {
namespace {

template <class Matcher>
std::unique_ptr<StereoMatcher> make(const StereoOptions& options) {
  return std::make_unique<Matcher>(options);
}

/// All matchers, by the name in settings.
struct NamedMatcher {
  const char* name;
  std::unique_ptr<StereoMatcher> (*make)(const StereoOptions&);
};
constexpr NamedMatcher kMatchers[] = {
    {"elas", make<ElasMatcher>}, {"sgbm", make<SgbmMatcher>}, {"onnx", make<OnnxMatcher>}};

}  // namespace

std::vector<std::string> stereoMethods() {
  std::vector<std::string> names;
  for (const NamedMatcher& matcher : kMatchers) names.emplace_back(matcher.name);
  return names;
}

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
  const auto named = [&](const NamedMatcher& matcher) { return options.method == matcher.name; };
  return std::find_if(std::begin(kMatchers), std::end(kMatchers), named)->make(options);
}

}  // namespace softscope
