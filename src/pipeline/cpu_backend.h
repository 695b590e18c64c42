// src/pipeline/cpu_backend.h: all stages on the CPU.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/parallel.h"
#include "core/stereo_rig.h"
#include "deform/graph/model_warp.h"
#include "deform/solver/lm_solver.h"
#include "fusion/frame_comparer.h"
#include "fusion/model_updater.h"
#include "fusion/surface_search.h"
#include "pipeline/frame/frame_ahead.h"
#include "pipeline/frame/match_stage.h"
#include "pipeline/frame/stereo_stage.h"
#include "pipeline/options/reconstruction_options.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/tracks/look_stage.h"
#include "pose/pose_search.h"

namespace softscope {

/// What takes the place of the processor's own stages, and how the whole is named.
struct BackendParts {
  std::string name = "cpu", device = "processor";
  StereoStageFactory makeStereo = makeCpuStereoStage;
  MatchStageFactory makeMatching = makeCpuMatchStage;
  std::function<std::unique_ptr<DeformSolver>(const DeformOptions&)> makeSolver =
      [](const DeformOptions& options) { return makeDeformSolver(options); };
  std::function<std::unique_ptr<PoseSearch>()> makePoseSearch = [] {
    return std::make_unique<CpuPoseSearch>();
  };
  FrameSurveyFactory makeSurvey = [](const RectifiedRig&) {
    return std::make_unique<CpuFrameSurvey>();
  };
  std::function<std::unique_ptr<FrameComparer>(const RectifiedRig&)> makeComparer =
      [](const RectifiedRig&) { return std::make_unique<CpuFrameComparer>(); };
  std::function<std::unique_ptr<ModelUpdater>(const RectifiedRig&)> makeUpdater =
      [](const RectifiedRig&) { return std::make_unique<CpuModelUpdater>(); };
  std::function<std::unique_ptr<ModelWarp>()> makeWarp = [] {
    return std::make_unique<CpuModelWarp>();
  };
  std::function<std::unique_ptr<SurfaceSearch>()> makeSurface = [] {
    return std::make_unique<CpuSurfaceSearch>();
  };
  std::function<std::unique_ptr<LookStage>()> makeLooks = [] {
    return std::make_unique<CpuLookStage>();
  };
  /// From so many threads on, depths of the next frames are measured beside the stages of this one,
  /// and the graph grows beside the stages up to the warp.
  int ahead_from_threads = 2;
  FramesAhead ahead;
  std::shared_ptr<ThreadLimit>
      thread_limit;  // of the process, as long as the back end lives; may be null
};

/// Same input, same bytes, whatever the number of threads.
/// Throws OptionError for bad options, InputError where the calibration can't be used, and what the
/// parts throw.
std::unique_ptr<ReconstructionBackend> makeCpuBackend(const StereoCalibration& calibration,
                                                      const ReconstructionOptions& options,
                                                      const BackendParts& parts = {});

}  // namespace softscope
