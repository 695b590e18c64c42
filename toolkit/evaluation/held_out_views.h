// toolkit/evaluation/held_out_views.h: evaluation on frames that were held out of the run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "toolkit/evaluation/evaluate_view.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

struct HeldOutView {
  int frame = 0;
  PictureErrors picture;  // of the model and pose of the previous frame
  PictureErrors control;  // of the previous image, over the same pixels
};

/// The usual split of EndoNeRF clips (frames 1, n + 1, 2n +
/// 1, … are tested), for a causal method: the compared model
/// contains neither the held-out frame nor later frames.
struct HeldOutResult {
  int every = 0;  // 0: no frame held out
  std::vector<HeldOutView> views;
  std::vector<int> not_drawn;  // held out, but without a model, a pose or an image
};

/// `pictures`: rig and folder of the sequence. Throws InputError as ViewJudge
/// does. `progress_continues` is called after each view; false requests a stop.
HeldOutResult judgeHeldOut(
    const JudgedRun& run, const SequenceTruth& pictures,
    const std::function<bool()>& progress_continues = [] { return true; });

/// Means over the views; null without views.
FactSheet::Json heldOutJson(const HeldOutResult& result);
/// Adds nothing if no frame was held out.
void addHeldOutFacts(const HeldOutResult& result, FactSheet& facts);
std::vector<std::string> heldOutWarnings(const HeldOutResult& result);

}  // namespace softscope
