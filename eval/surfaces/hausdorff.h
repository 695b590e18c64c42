// eval/surfaces/hausdorff.h: symmetric distances of two point sets.
#pragma once

#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// The "95 % Hausdorff distance" has three different definitions; all are given by name.
struct HausdorffDistances {
  double hd95_max_of_directed_mm = Statistics::kNone;   // DeepMind, MetricsReloaded
  double hd95_pooled_mm = Statistics::kNone;            // MedPy: both directions pooled
  double hd95_mean_of_directed_mm = Statistics::kNone;  // plastimatch, SlicerRT
  double hd_mm = Statistics::kNone;                     // the largest of all
  double assd_mm = Statistics::kNone;                   // mean of the pooled distances
  double masd_mm = Statistics::kNone;                   // mean of both directed means
};

/// Distances of the points of the first set to the second set, and of the
/// second to the first, mm. Without NaNs; all NaN if one direction is empty.
HausdorffDistances hausdorffDistances(const std::vector<double>& forth_mm,
                                      const std::vector<double>& back_mm);

}  // namespace softscope
