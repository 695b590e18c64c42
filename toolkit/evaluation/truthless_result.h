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

/// NaN = not measured. A frame that was not fused has time and coverage only
/// and is excluded from all statistics. A step starts at the previous frame.
struct TruthlessFrame {
  double time_s = Statistics::kNone;
  double backprojection_mm = Statistics::kNone;  // as reported by the run
  double coverage = Statistics::kNone;           // share of tissue with depth, by the run
  double step_mm = Statistics::kNone, step_deg = Statistics::kNone;
  double second_difference_mm = Statistics::kNone;  // second difference of the positions
  PictureErrors picture;                            // rendered model against the left image
};

struct TruthlessResult {
  std::string run, sequence;                 // paths as given
  FrameOutcomes outcomes;                    // of the run
  std::map<int, TruthlessFrame> frames;      // every frame with a pose
  std::vector<int> drawn;                    // those with a saved model and an image
  DrawnPair last_drawn;                      // of the last of these frames
  double moved_mm = Statistics::kNone;       // first to last pose: drift of a static scope
  double turned_deg = Statistics::kNone;     // the same for the orientation
  double jitter_rms_mm = Statistics::kNone;  // root mean square of the second differences
  HeldOutResult held_out;
  bool interrupted = false;
  std::vector<std::string> warnings;
};

/// Depth, poses and back-projection as reported by the run; for frames with a saved model also the
/// rendered view against the image, unless `views` is false. `after_model` as for judgeSeries().
/// Throws InputError for an unreadable sequence or one with fewer frames than the run.
TruthlessResult judgeWithoutTruth(const JudgedRun& run, const std::filesystem::path& sequence,
                                  bool views, const std::function<bool()>& after_model);

FactSheet::Json truthlessJson(const TruthlessResult& result);
FactSheet truthlessFacts(const TruthlessResult& result);
std::string truthlessCsv(const TruthlessResult& result);
/// PSNR, SSIM, back-projection and camera steps over time, in one column.
VectorDrawing truthlessPlots(const TruthlessResult& result);

}  // namespace softscope
