// eval/images/map_differences.h: measured minus true values of a map of depth or disparity.
#pragma once

#include <vector>

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// One value per evaluated pixel, row by row.
struct MapDifferences {
  std::vector<double> with_sign;  // measured - truth
  std::vector<double> magnitude;
};

/// Over measured, unmasked pixels with known truth. `what`: name
/// of the maps in messages. Throws InputError for different sizes.
MapDifferences mapDifferences(const Raster<float>& measured, const Raster<float>& truth,
                              const Mask& ignore, const char* what);

/// Share of the values above each threshold, in percent.
std::vector<double> percentsAbove(const std::vector<double>& values,
                                  const std::vector<double>& thresholds);

/// Throws OptionError for a threshold below 0.
void requireThresholds(const char* field, const std::vector<double>& thresholds);

}  // namespace softscope
