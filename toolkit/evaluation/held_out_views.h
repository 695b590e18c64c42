// toolkit/evaluation/held_out_views.h: the model rendered for frames that were held out of the run.
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
  PictureErrors picture;  // of the model as the frame before left it, drawn from that frame's pose
  PictureErrors control;  // of the image of the frame before, over the same pixels
};

/// The usual split of EndoNeRF's clips (frames 1, n + 1, 2n + 1, … for the test), for a method that
/// looks back alone: nothing of a held-out frame, and nothing later, is in the model that is
/// compared with it.
struct HeldOutResult {
  int every = 0;  // 0: the run held no frame out
  std::vector<HeldOutView> views;
  std::vector<int> not_drawn;  // held out, but without a model, a pose or an image
};

/// `pictures`: rig and folder of the sequence. Throws InputError as ViewJudge does. `goes_on` is
/// asked after each view.
HeldOutResult judgeHeldOut(
    const JudgedRun& run, const SequenceTruth& pictures,
    const std::function<bool()>& goes_on = [] { return true; });

/// Means over the views; null where there are none.
FactSheet::Json heldOutJson(const HeldOutResult& result);
/// Nothing where no frame was held out.
void addHeldOutFacts(const HeldOutResult& result, FactSheet& facts);
std::vector<std::string> heldOutWarnings(const HeldOutResult& result);

}  // namespace softscope
