// eval/motion/track_errors.cpp: one pass over the estimates.
#include "eval/motion/track_errors.h"

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
           sample.visible, unseen.count({sample.frame, sample.id}) > 0});
    }
  }
  if (!truth.empty())
    errors.reported_share =
        static_cast<double>(errors.each.size()) / static_cast<double>(truth.size());
  summarise(errors, moves.rbegin()->first);
  return errors;
}

}  // namespace softscope
