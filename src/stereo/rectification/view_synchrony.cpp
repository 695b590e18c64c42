#include "stereo/rectification/view_synchrony.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace softscope {
namespace {

constexpr double kAgreesPx = 0.25;    // of a match with the model of all frames
constexpr double kClearlyMore = 1.2;  // than the count at offset 0
constexpr int kFewestAgreeing = 200;  // for a decision
constexpr int kBeyondDoubt = 2;       // times the count of any other offset
constexpr double kUnknownPx = std::numeric_limits<double>::infinity();

}  // namespace

void SynchronyMeter::add(const GrayImage& left, const std::array<GrayImage, kOffsets>& rights) {
  const RowMeter unused(left, disparity_max_px_);  // each match narrows its range
  scale_ = unused.scale();
  for (int k = 0; k < kOffsets; ++k) {
    RowMeter meter = unused;
    frames_[k].push_back(meter.match(rights[k]));
  }
}

SynchronyMeter::Agreement SynchronyMeter::agreementAt(int offset) const {
  const std::vector<std::vector<RowMatch>>& frames = frames_[offset + kReach];
  std::vector<RowMatch> all;
  for (const std::vector<RowMatch>& frame : frames)
    all.insert(all.end(), frame.begin(), frame.end());
  const RowAlignment shared = fitRowModel(all, scale_);
  int agreeing = 0, compared = 0;
  std::set<std::pair<int, int>> pixels;
  double sum_px2 = 0;
  for (const std::vector<RowMatch>& frame : frames) {
    const RowAlignment own = fitRowModel(frame, scale_);
    pixels.clear();
    for (const RowMatch& match : frame) {
      const double shared_px = shared.at(match.u_right_px, match.v_right_px);
      const double apart_px = own.at(match.u_right_px, match.v_right_px) - shared_px;
      if (std::abs(match.difference_px - shared_px) < kAgreesPx)
        pixels.emplace(match.v_left_px, match.u_left_px);
      if (!own.known()) continue;
      sum_px2 += apart_px * apart_px;
      ++compared;
    }
    agreeing += static_cast<int>(pixels.size());
  }
  return {agreeing, compared > 0 ? std::sqrt(sum_px2 / compared) : kUnknownPx};
}

bool SynchronyMeter::isClear() const {
  const int as_is = agreementAt(0).matches;
  if (as_is < kFewestAgreeing) return false;
  for (int offset = -kReach; offset <= kReach; ++offset)
    if (offset != 0 && kBeyondDoubt * agreementAt(offset).matches > as_is) return false;
  return true;
}

ViewSynchrony SynchronyMeter::result() const {
  const Agreement as_is = agreementAt(0);
  ViewSynchrony found;
  found.agreeing = found.agreeing_as_is = as_is.matches;
  const double enough = std::max<double>(kFewestAgreeing, kClearlyMore * as_is.matches);
  for (int offset = -kReach; offset <= kReach; ++offset) {
    const Agreement there = agreementAt(offset);
    if (there.matches < enough || there.matches <= found.agreeing) continue;
    // A scope that moves sideways may bring one view closer to where the other one was. Matches are
    // then easier, but not those of one moment.
    if (there.scatter_px > as_is.scatter_px) continue;
    found.right_offset = offset;
    found.agreeing = there.matches;
  }
  return found;
}

}  // namespace softscope
