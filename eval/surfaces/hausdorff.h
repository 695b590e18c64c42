// eval/surfaces/hausdorff.h: the distances of two sets from each other, both ways, in one number.
#pragma once

#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// The "95 % Hausdorff distance" has three definitions that differ; none is given without its name.
struct HausdorffDistances {
  double hd95_max_of_directed_mm = Statistics::kNone;   // DeepMind, MetricsReloaded
  double hd95_pooled_mm = Statistics::kNone;            // MedPy: of both ways' distances together
  double hd95_mean_of_directed_mm = Statistics::kNone;  // plastimatch, SlicerRT
  double hd_mm = Statistics::kNone;                     // the largest of all
  double assd_mm = Statistics::kNone;                   // mean of both ways' distances together
  double masd_mm = Statistics::kNone;                   // mean of the two ways' means
};

/// Distances of the first set's points from the second set, and of the second's from the first, mm.
/// NaNs are left out; all NaN where one way has no distance.
HausdorffDistances hausdorffDistances(const std::vector<double>& forth_mm,
                                      const std::vector<double>& back_mm);

}  // namespace softscope
