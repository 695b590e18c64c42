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

}  // namespace

void SynchronyMeter::add(const GrayImage& left, const std::array<GrayImage, kOffsets>& rights) {
  const RowMeter unused(left, disparity_max_px_);  // each match narrows its range
  scale_ = unused.scale();
  for (int k = 0; k < kOffsets; ++k) {
    RowMeter meter = unused;
    frames_[k].push_back(meter.match(rights[k]));
  }
}

RowAlignment SynchronyMeter::modelAt(int offset) const {
  FrameMatches all;
  for (const FrameMatches& frame : framesAt(offset))
    all.insert(all.end(), frame.begin(), frame.end());
  return fitRowModel(all, scale_);
}

int SynchronyMeter::agreeingAt(int offset) const {
  const RowAlignment shared = modelAt(offset);
  std::size_t agreeing = 0;
  for (const FrameMatches& frame : framesAt(offset)) {
    std::set<std::pair<int, int>> pixels;
    for (const RowMatch& m : frame)
      if (std::abs(m.difference_px - shared.at(m.u_right_px, m.v_right_px)) < kAgreesPx)
        pixels.emplace(m.v_left_px, m.u_left_px);
    agreeing += pixels.size();
  }
  return static_cast<int>(agreeing);
}

double SynchronyMeter::scatterAt(int offset) const {
  const RowAlignment shared = modelAt(offset);
  int compared = 0;
  double sum_px2 = 0;
  for (const FrameMatches& frame : framesAt(offset)) {
    const RowAlignment own = fitRowModel(frame, scale_);
    if (!own.known()) continue;
    for (const RowMatch& m : frame)
      sum_px2 +=
          std::pow(own.at(m.u_right_px, m.v_right_px) - shared.at(m.u_right_px, m.v_right_px), 2);
    compared += static_cast<int>(frame.size());
  }
  return compared > 0 ? std::sqrt(sum_px2 / compared) : std::numeric_limits<double>::infinity();
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
    // A scope that moves sideways may bring one view closer to where the other one was. Matches are
    // then easier, but not those of one moment.
    if (scatterAt(offset) > scatterAt(0)) continue;
    found.right_offset = offset;
    found.agreeing = agreeing;
  }
  return found;
}

}  // namespace softscope
