#include "stereo/rectification/view_synchrony.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "stereo/rectification/rolled_rows.h"

namespace softscope {
namespace {

constexpr double kAgreesPx = RowAlignment::kAgreesPx;  // a frame's model with that of all frames
constexpr double kSteadier = 0.7;                      // times the scatter at offset 0, at most
constexpr int kFewestAgreeing = 200;                   // for a decision
constexpr int kBeyondDoubt = 2;                        // times the count of any other offset
constexpr int kFewestJudged = 50;  // matches of all frames, to tell them from wrong ones
constexpr double kUnsteadyPx = 2;  // scatter: the frames show different rows
constexpr double kScaled = 0.008;  // of rows; calibrations have a tenth of it

}  // namespace

void SynchronyMeter::add(const GrayImage& left, const std::array<GrayImage, kOffsets>& rights) {
  const RowMeter unused(left, disparity_max_px_);  // each match narrows its range
  scale_ = unused.scale();
  if (frames_.front().empty()) rolled_ = findRolledRows(unused, rights[kReach]);
  for (int k = 0; k < kOffsets; ++k) {
    RowMeter meter = unused;
    frames_[k].push_back(meter.match(rights[k], {}, rolled_));
  }
}

SynchronyMeter::FrameMatches SynchronyMeter::allAt(int offset) const {
  FrameMatches all;
  for (const FrameMatches& frame : framesAt(offset))
    all.insert(all.end(), frame.begin(), frame.end());
  return all;
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
    const RowAlignment own = fitRowModel(frame, scale_, rolled_);
    if (!own.known()) continue;
    for (const RowMatch& m : frame)
      sum_px2 +=
          std::pow(own.at(m.u_right_px, m.v_right_px) - shared.at(m.u_right_px, m.v_right_px), 2);
    compared += static_cast<int>(frame.size());
  }
  return compared > 0 ? std::sqrt(sum_px2 / compared) : std::numeric_limits<double>::infinity();
}

RowPlane SynchronyMeter::rowsAt(int offset) const {
  return agreeingAt(offset) < kFewestAgreeing ? RowPlane()
                                              : fitRowPlane(allAt(offset), scale_, rolled_);
}

RowDoubt SynchronyMeter::doubtAt(int offset) const {
  RowDoubt doubt;
  doubt.rows = rowsAt(offset);
  doubt.matches = static_cast<int>(allAt(offset).size());
  if (doubt.matches < kFewestJudged) return doubt;
  const RowAlignment model = modelAt(offset);
  const double scatter_px = scatterAt(offset);  // infinite where no frame has a model
  doubt.agreeing_share = model.agreeing_share;
  doubt.fan_px = model.model[4];
  doubt.is_rolled = rolled_.isKnown() && doubt.rollRad() != 0;
  doubt.is_scaled = std::abs(doubt.scale()) > kScaled;
  doubt.is_strong = doubt.agreeing_share < RowAlignment::kByChance ||
                    (std::isfinite(scatter_px) && scatter_px > kUnsteadyPx);
  return doubt;
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
  for (int offset = -kReach; offset <= kReach; ++offset) {
    const int agreeing = agreeingAt(offset);
    if (agreeing < kFewestAgreeing || agreeing <= found.agreeing) continue;
    // More matches alone prove nothing: a scope that moves sideways may bring one view closer to
    // where the other one was, and matches are then easier. Those of one moment agree in all
    // frames.
    if (scatterAt(offset) > std::min(kAgreesPx, kSteadier * scatterAt(0))) continue;
    found.right_offset = offset;
    found.agreeing = agreeing;
  }
  return found;
}

}  // namespace softscope
