// toolkit/run/frame_outcomes.h: how many frames of a run its numbers stand on.
#pragma once

#include <map>
#include <string>

#include "pipeline/frame_record.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/plots/outcome_strip.h"

namespace softscope {

/// Fused: the model learned from the frame. Lost: the model was not found in it. Skipped: the
/// others that changed nothing (too little depth, no warp, unconfirmed, unreadable, unpaired).
FusionOutcome outcomeOf(FrameStatus status);

/// By frame number. Empty where the run's frames.csv has no column `status`.
class FrameOutcomes {
 public:
  void set(int frame, FusionOutcome outcome) { each_[frame] = outcome; }
  bool empty() const { return each_.empty(); }
  int count() const { return static_cast<int>(each_.size()); }
  int count(FusionOutcome outcome) const;
  /// Whether the frame counts; true where nothing is known of it.
  bool fused(int frame) const;
  const std::map<int, FusionOutcome>& each() const { return each_; }

  /// frames, fused, skipped, lost, and the shares of the last three; null for what is not known.
  FactSheet::Json json() const;
  /// "1 of 33 fused, 0 skipped, 32 lost".
  std::string text() const;
  /// One letter per frame, or per part of a long run, whose worst frame it shows: # fused,
  /// s skipped, L lost.
  std::string strip() const;

 private:
  std::map<int, FusionOutcome> each_;
};

/// The lines that every summary begins with; nothing where no outcome is known.
void addOutcomeFacts(const FrameOutcomes& outcomes, FactSheet& facts);

}  // namespace softscope
