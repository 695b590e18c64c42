#include "stereo/rectification/view_synchrony.h"

#include <algorithm>
#include <cmath>

namespace softscope {
namespace {

constexpr double kAgreesPx = 0.25;    // of a match with the model of all frames
constexpr double kClearlyMore = 1.2;  // than the count at offset 0
constexpr int kFewestAgreeing = 200;  // for a decision
constexpr int kBeyondDoubt = 2;       // times the count of any other offset

}  // namespace

void SynchronyMeter::add(const GrayImage& left, const std::array<GrayImage, kOffsets>& rights) {
  const RowMeter unused(left, disparity_max_px_);  // each match narrows its range
  scale_ = unused.scale();
  for (int k = 0; k < kOffsets; ++k) {
    RowMeter meter = unused;
    const std::vector<RowMatch> found = meter.match(rights[k]);
    matches_[k].insert(matches_[k].end(), found.begin(), found.end());
  }
}

int SynchronyMeter::agreeingAt(int offset) const {
  const std::vector<RowMatch>& matches = matches_[offset + kReach];
  const RowAlignment shared = fitRowModel(matches, scale_);
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), [&](const RowMatch& m) {
    return std::abs(m.difference_px - shared.at(m.u_right_px, m.v_right_px)) < kAgreesPx;
  }));
}

bool SynchronyMeter::isClear() const {
  const int as_is = agreeingAt(0);
  if (as_is < kFewestAgreeing) return false;
  for (int offset = -kReach; offset <= kReach; ++offset)
    if (offset != 0 && kBeyondDoubt * agreeingAt(offset) > as_is) return false;
  return true;
}

ViewSynchrony SynchronyMeter::result() const {
  ViewSynchrony found;
  found.agreeing = found.agreeing_as_is = agreeingAt(0);
  const double enough = std::max<double>(kFewestAgreeing, kClearlyMore * found.agreeing_as_is);
  for (int offset = -kReach; offset <= kReach; ++offset) {
    const int agreeing = agreeingAt(offset);
    if (agreeing < enough || agreeing <= found.agreeing) continue;
    found.right_offset = offset;
    found.agreeing = agreeing;
  }
  return found;
}

}  // namespace softscope
