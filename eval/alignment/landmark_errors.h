// eval/alignment/landmark_errors.h: alignment by landmarks, with FRE and TRE.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "eval/alignment/rigid_alignment.h"
#include "eval/statistics/statistics.h"

namespace softscope {

/// FRE and TRE are two things: FRE is what the fit leaves at the points it was made of, and says
/// nothing of other places; TRE is the error at a point that the fit has not seen.
struct LandmarkErrors {
  RigidFit fit;       // of all landmarks
  Statistics fre_mm;  // at the landmarks, after the fit of all of them
  /// At each landmark after the fit of all others (leave one out); none with fewer than four.
  Statistics tre_mm;
};

/// Pairs of points, mm. Throws InputError as fitRigid does, and where they lie on one line.
LandmarkErrors landmarkErrors(const std::vector<Eigen::Vector3d>& test_mm,
                              const std::vector<Eigen::Vector3d>& reference_mm);

}  // namespace softscope
