// toolkit/evaluation/surface_error_map.cpp: colour range with arrows for values outside of it.
#include "toolkit/evaluation/surface_error_map.h"

#include <cmath>

#include "core/error.h"
#include "eval/statistics/statistics.h"
#include "toolkit/record/statistics_json.h"
#include "vtk_views/drawing/nice_ticks.h"

namespace softscope {

void ErrorColourOptions::validate() const {
  require(kind == "absolute" || kind == "signed" || kind == "none", "`errors=`", kind,
          "must be absolute, signed or none");
  require(range_mm >= 0 && std::isfinite(range_mm), "`range_mm=`", range_mm, "must be above 0");
}

SurfaceErrorMap colourErrors(const std::vector<double>& distance_mm,
                             const std::vector<double>& signed_mm,
                             const ErrorColourOptions& options) {
  const Statistics of_distance = statistics(distance_mm);
  SurfaceErrorMap map;
  map.colours.with_sign = options.kind == "signed";
  map.colours.limit_mm = options.range_mm > 0 ? options.range_mm : roundUp(of_distance.p95);
  map.each_mm = map.colours.with_sign ? signed_mm : distance_mm;
  for (const double error_mm : map.each_mm) {
    map.bar.any_above |= error_mm > map.colours.limit_mm;
    map.bar.any_below |= error_mm < map.colours.low_mm();
    map.bar.any_missing |= std::isnan(error_mm);
  }
  if (map.colours.with_sign) map.bar.label = "signed distance, outside positive [mm]";
  map.json = {{"kind", options.kind},
              {"range_mm", {map.colours.low_mm(), map.colours.limit_mm}},
              {"distance", statisticsJson(of_distance, "_mm")}};
  if (map.colours.with_sign) map.json["signed"] = statisticsJson(statistics(signed_mm), "_mm");
  return map;
}

SurfaceErrorMap colourErrors(const std::vector<ClosestPoint>& closest,
                             const ErrorColourOptions& options) {
  std::vector<double> distance_mm, signed_mm;
  for (const ClosestPoint& c : closest) {
    distance_mm.push_back(c.distance_mm);
    signed_mm.push_back(c.signed_distance_mm);
  }
  return colourErrors(distance_mm, signed_mm, options);
}

void SurfaceErrorMap::explainIn(FigureFoot& foot) const {
  foot.colours = colours;
  foot.bar = bar;
}

}  // namespace softscope
