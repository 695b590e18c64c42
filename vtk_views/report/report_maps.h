// vtk_views/report/report_maps.h: error maps in the form in which a page carries them.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/files/error_map.h"

namespace softscope {

/// One case: a surface, or the moments of a series.
struct ReportMap {
  std::string name;
  std::vector<ErrorMap> moments;  // at least one
};

/// JSON for viewer.js: places as 16 bits of the case's box (of 0.3 m: 5 um), errors as 16 bits of
/// the case's largest (of 60 mm: 1 um), base64; and the two palettes.
std::string reportMapsJson(const std::vector<ReportMap>& maps, double limit_mm);

}  // namespace softscope
