// toolkit/evaluation/map_kinds.cpp: checks of names and values of maps.
#include "toolkit/evaluation/map_kinds.h"

#include <cmath>

#include "core/error.h"
#include "eval/statistics/statistics.h"
#include "io/text/message.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kOpposite = -0.5;  // correlation of measured and true map
constexpr double kConstant = 1e-9;  // relative variance due to rounding

/// Over pixels measured in both maps; NaN if one map is constant.
double correlation(const Raster<float>& a, const Raster<float>& b) {
  double n = 0, sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = a.values[i], y = b.values[i];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    n += 1, sum_a += x, sum_b += y, sum_aa += x * x, sum_bb += y * y, sum_ab += x * y;
  }
  const double spread_a = n * sum_aa - sum_a * sum_a, spread_b = n * sum_bb - sum_b * sum_b;
  const bool constant = spread_a <= kConstant * n * sum_aa || spread_b <= kConstant * n * sum_bb;
  return constant ? std::nan("") : (n * sum_ab - sum_a * sum_b) / std::sqrt(spread_a * spread_b);
}

}  // namespace

const char* nameOf(MapKind kind) { return kind == MapKind::kDepth ? "depth" : "disparity"; }

void requireNamedAs(MapKind kind, const fs::path& file) {
  const std::string own = nameOf(kind),
                    other = nameOf(kind == MapKind::kDepth ? MapKind::kDisparity : MapKind::kDepth);
  const std::string name = file.filename().string();
  const bool says_own = name.find(own) != std::string::npos,
             says_other = name.find(other) != std::string::npos;
  const bool other_folder = file.parent_path().filename() == other;
  if (says_own || !(says_other || other_folder)) return;
  throw InputError(say(shown(file), ": is named a ", other, " map, but the maps are compared as ",
                       own, " maps; give two maps of one kind, with `map_kind=`"));
}

void requireDisparities(const Raster<float>& disparity_px, const fs::path& file) {
  const double largest_px =
      statistics({disparity_px.values.begin(), disparity_px.values.end()}).max;
  if (largest_px > disparity_px.width_px)
    throw InputError(say(shown(file), ": has values up to ", largest_px,
                         ", but a disparity is at most ", disparity_px.width_px,
                         " px, the width of the image. A depth map? Then give two depth maps and "
                         "`map_kind=` depth"));
}

std::string oppositesWarning(const std::string& name, const Raster<float>& measured,
                             const Raster<float>& truth) {
  const double both = correlation(measured, truth);
  if (!(both < kOpposite)) return {};
  return say(name, ": its values fall where the true ones rise (correlation ", fixed(both, 2),
             "). Is one of both a depth map and the other a disparity map?");
}

std::string unitOfMap(const fs::path& file, MapKind kind) {
  const bool depth = kind == MapKind::kDepth;
  const std::string ending = file.extension().string();
  const std::string step = depth ? "16 bits, 100 steps per mm" : "16 bits, 256 steps per px";
  if (ending == ".png" || ending == ".PNG") return step;
  if (ending == ".npy") return "metres";
  const std::string floats = depth ? "mm" : "px";
  return ending == ".pfm" || ending == ".PFM" ? floats : "floats in " + floats + ", or " + step;
}

}  // namespace softscope
