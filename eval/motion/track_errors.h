// eval/motion/track_errors.h: errors of tracked material points against ground truth.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// Position of one tissue point in one frame.
struct TrackSample {
  int frame = 0;
  int id = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  bool visible = true;
  double sigma_mm = Statistics::kNone;  // predicted root mean square error
};

/// Estimate with its true position.
struct TrackError {
  int frame = 0;
  int id = 0;
  Eigen::Vector3d offset_mm = Eigen::Vector3d::Zero();  // from the truth, in its world
  double control_mm = 0;                // of a static estimate: |truth now - truth at the start|
  bool visible = true;                  // according to the estimate
  bool unseen = false;                  // according to the ground truth
  double sigma_mm = Statistics::kNone;  // predicted root mean square error

  double errorMm() const { return offset_mm.norm(); }
};

/// Errors relative to the predicted sigma.
struct PredictedTrackErrors {
  std::size_t count = 0;                        // estimates with a prediction
  double error_over_sigma = Statistics::kNone;  // root mean square; 1 for a correct sigma
  double within_2_sigma_share = Statistics::kNone;
};

struct TrackErrors {
  std::vector<TrackError> each;  // in the order of the estimates
  Statistics error_mm;
  Statistics visible_mm;     // estimates marked as visible
  Statistics hidden_mm;      // other estimates
  Statistics observed_mm;    // tissue truly visible to the camera
  Statistics predicted_mm;   // other tissue: moved by the warp only
  Statistics control_mm;     // the no-motion control
  Statistics last_frame_mm;  // in the last evaluated frame
  PredictedTrackErrors sigma;
  double reported_share = Statistics::kNone;  // estimates with a truth / all true positions
  std::size_t without_truth = 0;              // estimates of points or frames without truth
  std::size_t lost = 0;                       // estimates that are not finite
};

/// True positions in the world frame, by (frame, id).
using TrueTracks = std::map<std::pair<int, int>, Eigen::Vector3d>;

/// Frames and ids of points not visible to the camera.
using UnseenTracks = std::set<std::pair<int, int>>;

/// Per frame: transform from the world of the estimate into the true world, through the camera.
using TruthFromEstimate = std::map<int, Eigen::Isometry3d>;

/// Evaluates the frames in `moves`; estimates of other frames count
/// as without truth. The control starts at the first of these frames.
TrackErrors trackErrors(const TrueTracks& truth, const std::vector<TrackSample>& estimate,
                        const TruthFromEstimate& moves, const UnseenTracks& unseen = {});

}  // namespace softscope
