// vtk_views/plots/worst_frames_plot.h: the frames with the largest errors, side by side.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

/// One value a frame, worst first; chosen elsewhere.
struct WorstFramesData {
  std::string title;
  std::string error_label = "distance to the surface [mm]";
  std::vector<int> frames;
  std::vector<double> mean, p95;
};

/// A bar of the mean inside a wider one up to the 95th percentile, over each frame's number.
/// Throws Error where the lengths differ or there is no frame.
VectorDrawing drawWorstFrames(const WorstFramesData& data, const PlotStyle& style = {});

}  // namespace softscope
