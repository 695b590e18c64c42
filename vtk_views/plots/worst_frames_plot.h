// vtk_views/plots/worst_frames_plot.h: bars of the frames with the largest errors.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

/// One value per frame, in descending order; selected elsewhere.
struct WorstFramesData {
  std::string title;
  std::string error_label = "distance to the surface [mm]";
  std::vector<int> frames;
  std::vector<double> mean, p95;
};

/// Bar of the mean inside a wider bar up to the 95th percentile, above
/// the frame number. Throws Error for different lengths or no frame.
VectorDrawing drawWorstFrames(const WorstFramesData& data, const PlotStyle& style = {});

}  // namespace softscope
