// toolkit/evaluation/truthless_result.h: evaluation of a run without ground truth.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "eval/images/picture_errors.h"
#include "eval/statistics/statistics.h"
#include "toolkit/evaluation/evaluate_view.h"
#include "toolkit/evaluation/held_out_views.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/run/run_reader.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// NaN = not measured. Of a frame that was not fused time and coverage alone are known, and no
/// number over the frames has it in. A step leads from the frame before.
struct TruthlessFrame {
  double time_s = Statistics::kNone;
  double backprojection_mm = Statistics::kNone;  // as the run measured it
  double coverage = Statistics::kNone;           // share of the tissue that has depth: the run's
  double step_mm = Statistics::kNone, step_deg = Statistics::kNone;
  double second_difference_mm = Statistics::kNone;  // length of that of the scope's positions
  PictureErrors picture;  // of the model, drawn from the run's pose, against the left image
};

struct TruthlessResult {
  std::string run, sequence;              // as the user named them
  FrameOutcomes outcomes;                 // of the run
  std::map<int, TruthlessFrame> frames;   // every frame with a pose
  std::vector<int> drawn;                 // those with a saved model and an image
  DrawnPair last_drawn;                   // of the last of them
  double moved_mm = Statistics::kNone;    // from the first to the last pose: drift of a still scope
  double turned_deg = Statistics::kNone;  // the same of its direction
  double jitter_rms_mm = Statistics::kNone;  // root mean square of the second differences
  HeldOutResult held_out;
  bool interrupted = false;
  std::vector<std::string> warnings;
};

/// Depth, poses and back-projection as the run wrote them; of frames with a saved model the drawn
/// view against the image, unless `views` is false. `after_model` as for judgeSeries(). Throws
/// InputError where the sequence can't be read or has fewer frames than the run.
TruthlessResult judgeWithoutTruth(const JudgedRun& run, const std::filesystem::path& sequence,
                                  bool views, const std::function<bool()>& after_model);

FactSheet::Json truthlessJson(const TruthlessResult& result);
FactSheet truthlessFacts(const TruthlessResult& result);
std::string truthlessCsv(const TruthlessResult& result);
/// PSNR, SSIM, back-projection and the scope's steps over time, one under the other.
VectorDrawing truthlessPlots(const TruthlessResult& result);

}  // namespace softscope
