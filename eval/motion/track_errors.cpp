// eval/motion/track_errors.cpp: one pass over the estimates.
#include "eval/motion/track_errors.h"

#include <cmath>

namespace softscope {
namespace {

void summarise(TrackErrors& errors, int last_frame) {
  std::vector<double> all, visible, hidden, observed, predicted, control, last;
  for (const TrackError& e : errors.each) {
    all.push_back(e.errorMm());
    control.push_back(e.control_mm);
    (e.visible ? visible : hidden).push_back(e.errorMm());
    (e.unseen ? predicted : observed).push_back(e.errorMm());
    if (e.frame == last_frame) last.push_back(e.errorMm());
  }
  errors.error_mm = statistics(all);
  errors.visible_mm = statistics(visible);
  errors.hidden_mm = statistics(hidden);
  errors.observed_mm = statistics(observed);
  errors.predicted_mm = statistics(predicted);
  errors.control_mm = statistics(control);
  errors.last_frame_mm = statistics(last);
}

PredictedTrackErrors overSigma(const std::vector<TrackError>& each) {
  PredictedTrackErrors result;
  double squares = 0;
  std::size_t within = 0;
  for (const TrackError& e : each) {
    if (!(e.sigma_mm > 0)) continue;
    const double ratio = e.errorMm() / e.sigma_mm;
    squares += ratio * ratio;
    within += ratio <= 2;
    ++result.count;
  }
  if (result.count == 0) return result;
  result.error_over_sigma = std::sqrt(squares / static_cast<double>(result.count));
  result.within_2_sigma_share = static_cast<double>(within) / static_cast<double>(result.count);
  return result;
}

}  // namespace

TrackErrors trackErrors(const TrueTracks& truth, const std::vector<TrackSample>& estimate,
                        const TruthFromEstimate& moves, const UnseenTracks& unseen) {
  TrackErrors errors;
  if (moves.empty()) return errors;
  for (const TrackSample& sample : estimate) {
    const auto found = truth.find({sample.frame, sample.id});
    const auto start = truth.find({moves.begin()->first, sample.id});
    const auto move = moves.find(sample.frame);
    if (!sample.position_mm.allFinite()) {
      ++errors.lost;
    } else if (found == truth.end() || move == moves.end()) {
      ++errors.without_truth;
    } else {
      errors.each.push_back(
          {sample.frame, sample.id, move->second * sample.position_mm - found->second,
           start == truth.end() ? Statistics::kNone : (found->second - start->second).norm(),
           sample.visible, unseen.count({sample.frame, sample.id}) > 0, sample.sigma_mm});
    }
  }
  if (!truth.empty())
    errors.reported_share =
        static_cast<double>(errors.each.size()) / static_cast<double>(truth.size());
  summarise(errors, moves.rbegin()->first);
  errors.sigma = overSigma(errors.each);
  return errors;
}

}  // namespace softscope
