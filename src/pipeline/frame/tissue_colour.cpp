#include "pipeline/frame/tissue_colour.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/median.h"
#include "core/redness.h"

namespace softscope {
namespace {

constexpr float kTissueShare = 0.5F;  // of the model's redness
constexpr std::size_t kStep = 7;      // between the pixels and points that are looked at

float rednessOf(const Rgb8& colour) {
  return redness(colour.red, colour.red + colour.green + colour.blue);
}

}  // namespace

bool isAsRed(const ColourImage& left, const Raster<float>& depth_mm, const PointModel& model) {
  std::vector<float> seen, known;
  for (std::size_t i = 0; i < left.size(); i += kStep)
    if (std::isfinite(depth_mm.values[i])) seen.push_back(rednessOf(left.values[i]));
  for (std::size_t i = 0; i < model.size(); i += kStep)
    known.push_back(rednessOf(model.colours[i]));
  if (seen.empty() || known.empty()) return false;
  return medianOf(std::move(seen)) >= kTissueShare * medianOf(std::move(known));
}

}  // namespace softscope
