// toolkit/evaluation/depth_map_result.h: disparity or depth maps against true ones.
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
  std::string measured;     // a map, or a folder of maps
  std::string reference;    // the true map, or as many in a folder; of the same kind
  std::string kind;         // disparity, depth; empty: by the names of the measured maps
  std::string calibration;  // of the rectified views: gives errors of disparity in mm, too
  std::string confidence;   // confidence.png of `depth`, or a folder of as many; empty: none

  /// Throws OptionError.
  MapKind mapKind() const;
};

/// One map. Values over NaN are left out; px of disparity, mm of depth.
struct JudgedMap {
  std::string name;
  std::optional<DisparityErrors> disparity;
  std::optional<DepthErrors> depth;
  IntervalCoverage intervals;
  Sparsification sparse;
};

/// The map with the largest mean error, to be looked at.
struct WorstMap {
  std::string name;
  double mean_error = -1;  // px or mm; below 0: none yet
  Raster<float> error;     // magnitude, NaN where not judged
};

/// Means over the maps; a map counts once, however many pixels it has.
struct DepthMapResult {
  std::string measured, reference;
  MapKind kind = MapKind::kDepth;
  std::vector<JudgedMap> maps;
  WorstMap worst;
  std::string measured_unit, true_unit;  // what the values of the files were taken for
  std::vector<std::string> warnings;
  bool interrupted = false;
};

/// True where `path` is a map, or a folder that holds maps and no run.
bool holdsDepthMaps(const std::filesystem::path& path);

/// Maps of folders belong together by the frame number that their names begin with, else by their
/// order. Throws InputError where a partner is missing, sizes differ, or a map's name or values say
/// that it is of the other kind; warns where the values of both maps run against each other, as
/// those of a depth and of a disparity map do.
DepthMapResult judgeDepthMaps(const DepthMapOptions& options, const Progress& progress = {});

FactSheet::Json depthMapJson(const DepthMapResult& result);
FactSheet depthMapFacts(const DepthMapResult& result);
/// The errors of the worst map, pixel by pixel. Of a result with a map that has errors.
VectorDrawing depthMapFigure(const DepthMapResult& result);
/// One line per map.
std::string depthMapCsv(const DepthMapResult& result);

}  // namespace softscope
