// src/features/feature_settings.h: keys, ranges and meanings of the settings of matching.
#pragma once

#include "core/setting_rules.h"
#include "features/matcher_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, SubpixelOptions& o) {
  v("matcher.subpixel.method", o.method, oneOf({"gauss-newton", "none"}),
    "sub-pixel refinement of matches");
}

template <class Visitor>
void describe(Visitor& v, MatcherOptions& o) {
  v("matcher.method", o.method, oneOf(matcherMethods()),
    "matches of the model view in the left image; surf-off: none");
  v("matcher.reach", o.reach, aboveUpTo(0, 1), "shifts are below this share of the longer side");
  describe(v, o.subpixel);
}

}  // namespace softscope
