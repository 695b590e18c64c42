// toolkit/run/frame_outcomes.h: counts of fused, skipped and lost frames of a run.
#pragma once

#include <map>
#include <string>

#include "pipeline/frame_record.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/plots/outcome_strip.h"

namespace softscope {

/// Fused: the frame updated the model. Lost: the pose of the model is unknown. Skipped: other
/// frames without effect (too little depth, no warp, unconfirmed, unreadable, unpaired).
FusionOutcome outcomeOf(FrameStatus status);

/// By frame number. Empty if frames.csv of the run has no column `status`.
class FrameOutcomes {
 public:
  void set(int frame, FusionOutcome outcome) { each_[frame] = outcome; }
  bool empty() const { return each_.empty(); }
  int count() const { return static_cast<int>(each_.size()); }
  int count(FusionOutcome outcome) const;
  /// True for a fused frame, and if its status is unknown.
  bool fused(int frame) const;
  const std::map<int, FusionOutcome>& each() const { return each_; }

  /// frames, fused, skipped, lost, and the shares of the last three; null if unknown.
  FactSheet::Json json() const;
  /// "1 of 33 fused, 0 skipped, 32 lost".
  std::string text() const;
  /// One letter per frame, or per interval of a long
  /// run (its worst frame): # fused, s skipped, L lost.
  std::string strip() const;

 private:
  std::map<int, FusionOutcome> each_;
};

/// First lines of every summary; adds nothing if no status is known.
void addOutcomeFacts(const FrameOutcomes& outcomes, FactSheet& facts);

}  // namespace softscope
