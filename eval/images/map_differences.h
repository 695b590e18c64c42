// eval/images/map_differences.h: measured minus true values of a map, of depth or of disparity.
#pragma once

#include <vector>

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// One value per judged pixel, row by row.
struct MapDifferences {
  std::vector<double> with_sign;  // measured - truth
  std::vector<double> magnitude;
};

/// Judges the pixels that are measured, whose truth is known and that the mask does not ignore.
/// `what`: the maps' name in messages. Throws InputError where sizes differ.
MapDifferences mapDifferences(const Raster<float>& measured, const Raster<float>& truth,
                              const Mask& ignore, const char* what);

/// Share of the values above each threshold, in percent.
std::vector<double> percentsAbove(const std::vector<double>& values,
                                  const std::vector<double>& thresholds);

/// Throws OptionError for a threshold below 0.
void requireThresholds(const char* field, const std::vector<double>& thresholds);

}  // namespace softscope
