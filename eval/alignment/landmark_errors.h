// eval/alignment/landmark_errors.h: alignment by landmarks, with FRE and TRE.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "eval/alignment/rigid_alignment.h"
#include "eval/statistics/statistics.h"

namespace softscope {

/// FRE is the residual of the fit at the landmarks used for it; it is no estimate of
/// the error elsewhere. TRE is the error at a landmark that was not used for the fit.
struct LandmarkErrors {
  RigidFit fit;       // of all landmarks
  Statistics fre_mm;  // residuals at the landmarks, for the fit of all of them
  /// At each landmark for the fit of all others (leave one out); none for fewer than four.
  Statistics tre_mm;
};

/// Pairs of points, mm. Throws InputError as fitRigid does, and for collinear points.
LandmarkErrors landmarkErrors(const std::vector<Eigen::Vector3d>& test_mm,
                              const std::vector<Eigen::Vector3d>& reference_mm);

}  // namespace softscope
