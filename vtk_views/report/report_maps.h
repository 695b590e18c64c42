// vtk_views/report/report_maps.h: error maps as data embedded in a page.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/files/error_map.h"

namespace softscope {

/// Case: one surface, or the frames of a series.
struct ReportMap {
  std::string name;
  std::vector<ErrorMap> moments;  // at least one
};

/// JSON for viewer.js: positions as 16 bits of the box of the case (of 0.3 m: 5 um),
/// errors as 16 bits of its maximum (of 60 mm: 1 um), base64; and both colour maps.
std::string reportMapsJson(const std::vector<ReportMap>& maps, double limit_mm);

}  // namespace softscope
