// toolkit/evaluation/depth_map_result.h: evaluation of disparity or depth maps against true maps.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/raster.h"
#include "eval/images/depth_errors.h"
#include "eval/images/disparity_errors.h"
#include "eval/images/predicted_sigma.h"
#include "toolkit/evaluation/map_kinds.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

struct DepthMapOptions {
  std::string measured;     // map, or folder of maps
  std::string reference;    // true map, or folder of as many; of the same kind
  std::string kind;         // disparity, depth; empty: from the names of the measured maps
  std::string calibration;  // of the rectified views: adds errors of disparity in mm
  std::string confidence;   // confidence.png of `depth`, or folder of as many; empty: none

  /// Throws OptionError.
  MapKind mapKind() const;
};

/// Errors of one map: px for disparity, mm for depth. Means without NaNs.
struct JudgedMap {
  std::string name;
  std::optional<DisparityErrors> disparity;
  std::optional<DepthErrors> depth;
  IntervalCoverage intervals;
  Sparsification sparse;
};

/// Map with the largest mean error.
struct WorstMap {
  std::string name;
  double mean_error = -1;  // px or mm; negative: none yet
  Raster<float> error;     // absolute error; NaN for excluded pixels
};

/// Means over the maps; each map has the same weight.
struct DepthMapResult {
  std::string measured, reference;
  MapKind kind = MapKind::kDepth;
  std::vector<JudgedMap> maps;
  WorstMap worst;
  std::string measured_unit, true_unit;  // assumed units of the files
  std::vector<std::string> warnings;
  bool interrupted = false;
};

/// True for a map, or a folder with maps and without a run.
bool holdsDepthMaps(const std::filesystem::path& path);

/// Maps of folders are paired by the leading frame number of their names,
/// else by their order. Throws InputError for a missing partner, different
/// sizes, or a map of the other kind by its name or values; warns for a
/// negative correlation of both maps, typical of depth against disparity.
DepthMapResult judgeDepthMaps(const DepthMapOptions& options, const Progress& progress = {});

FactSheet::Json depthMapJson(const DepthMapResult& result);
FactSheet depthMapFacts(const DepthMapResult& result);
/// Error image of the worst map. Requires a map with errors.
VectorDrawing depthMapFigure(const DepthMapResult& result);
/// One line per map.
std::string depthMapCsv(const DepthMapResult& result);

}  // namespace softscope
