// toolkit/evaluation/evaluate_series.h: evaluation of a run's models one after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/images/predicted_sigma.h"
#include "eval/surfaces/error_pool.h"
#include "eval/surfaces/model_errors.h"
#include "eval/surfaces/surface_alignment.h"
#include "toolkit/evaluation/evaluate_maps.h"
#include "toolkit/evaluation/evaluate_view.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

/// A tissue sample without a model point nearer than this is not reconstructed.
inline constexpr double kCompletenessMm = 1.0;

/// One model's errors; those of single points are not kept.
struct JudgedModel {
  int frame = 0;
  double time_s = 0;
  ModelErrors errors;
  std::optional<ViewErrors> view;  // none against a mesh, or where it wasn't asked for
};

/// Predicted standard errors of model points against their distances from the surface.
struct JudgedSigma {
  double known_share = Statistics::kNone;  // of the points, those that have one
  IntervalCoverage intervals;
  Sparsification sparse;
};

/// Values over all judged models.
struct SurfaceSeries {
  std::vector<JudgedModel> models;
  ErrorPool pool{1};
  Statistics all_mm, signed_mm, observed_mm, predicted_mm;  // of the pool
  JudgedSigma all_sigma, observed_sigma, predicted_sigma;   // of the pool
  double drift_mm_per_s = Statistics::kNone;      // Theil-Sen slope of the models' mean errors
  double drift_mm_per_frame = Statistics::kNone;  // the same over frame numbers
  std::vector<double> second_differences_mm;      // of the mean errors, one a model
  double jitter_rms_mm = Statistics::kNone;       // root mean square of these
  bool interrupted = false;                       // then nothing but `models` is right
  std::vector<ErrorMap> maps;                     // of some of the models, in their order

  /// The mean over the models of one of their values, NaNs left out.
  double meanOf(const std::function<double(const ModelErrors&)>& value) const;
  double meanOfView(const std::function<double(const ViewErrors&)>& value) const;
};

/// Called after each model; false asks to stop.
using AfterModel = std::function<bool()>;

/// Frames that were fused and have a true mesh and a model.
std::vector<int> framesToJudge(const JudgedRun& run, const SequenceTruth& truth);

/// Each model in the frame of its own moment's camera. The next moment is read meanwhile.
/// With `views`, each model is drawn as well and compared with the image. Throws InputError.
SurfaceSeries judgeSeries(const JudgedRun& run, const SequenceTruth& truth, bool views,
                          const AfterModel& after_model);

enum class MeshAlignment {
  kNone,
  kRigid,  // one, found with the first model, holds for all: drift stays visible
  kIcp,    // each model is aligned by itself
};

struct AlignedSeries {
  SurfaceSeries surface;
  std::vector<SurfaceAlignment> alignments;  // kNone: empty; kRigid: one; kIcp: one a model
};

/// Models of a run, by frame, against one surface (a CT's, say) that doesn't move.
AlignedSeries judgeAgainstMesh(const JudgedRun& run, const FrameFiles& models,
                               const TriangleMesh& mesh, MeshAlignment alignment,
                               const AfterModel& after_model);

}  // namespace softscope
