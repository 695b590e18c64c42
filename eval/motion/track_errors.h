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

/// Where one point of tissue was at one moment.
struct TrackSample {
  int frame = 0;
  int id = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  bool visible = true;
  double sigma_mm = Statistics::kNone;  // predicted root mean square error
};

/// One estimate that has its truth.
struct TrackError {
  int frame = 0;
  int id = 0;
  Eigen::Vector3d offset_mm = Eigen::Vector3d::Zero();  // from the truth, in its world
  double control_mm = 0;  // of an estimate that never moves: |truth now - truth at the start|
  bool visible = true;    // by the estimate
  bool unseen = false;    // by the ground truth
  double sigma_mm = Statistics::kNone;  // predicted root mean square error

  double errorMm() const { return offset_mm.norm(); }
};

/// Errors over what was predicted of them.
struct PredictedTrackErrors {
  std::size_t count = 0;                        // estimates with a prediction
  double error_over_sigma = Statistics::kNone;  // root mean square; 1 where sigma is true
  double within_2_sigma_share = Statistics::kNone;
};

struct TrackErrors {
  std::vector<TrackError> each;  // in the estimate's order
  Statistics error_mm;
  Statistics visible_mm;     // of those that the estimate calls visible
  Statistics hidden_mm;      // of the others
  Statistics observed_mm;    // of tissue that the camera truly sees now
  Statistics predicted_mm;   // of the rest: carried by the warp alone
  Statistics control_mm;     // the no-motion control
  Statistics last_frame_mm;  // in the last frame that is judged
  PredictedTrackErrors sigma;
  double reported_share = Statistics::kNone;  // estimates with a truth / all true positions
  std::size_t without_truth = 0;              // estimates of points or frames that truth lacks
  std::size_t lost = 0;                       // estimates that are not finite
};

/// True positions in the world's frame, by (frame, id).
using TrueTracks = std::map<std::pair<int, int>, Eigen::Vector3d>;

/// Frames and ids of points that the camera doesn't see.
using UnseenTracks = std::set<std::pair<int, int>>;

/// What brings an estimate of a frame into the true world, by way of the camera of that frame.
using TruthFromEstimate = std::map<int, Eigen::Isometry3d>;

/// Evaluates the frames in `moves`; estimates of others count as without truth. The control
/// starts at the first of these frames.
TrackErrors trackErrors(const TrueTracks& truth, const std::vector<TrackSample>& estimate,
                        const TruthFromEstimate& moves, const UnseenTracks& unseen = {});

}  // namespace softscope
