// toolkit/viewer/view_movie.h: video of a run, rendered off-screen.
#pragma once

#include <filesystem>
#include <vector>

#include "toolkit/progress.h"
#include "vtk_views/viewer/view_controls.h"

namespace softscope {

struct ViewMovieOptions {
  std::filesystem::path file;
  int width_px = 960, height_px = 720;
  double frames_per_second = 25;
  double speed = 1;     // seconds of the clip per second
  double seconds = 0;   // length of the video; 0: length of the clip at that speed
  double turn_deg = 0;  // total rotation of the camera about the model
  ViewState state;
  bool clean = false;  // without slider and texts
  bool overwrite = false;
};

/// Clip time of each video frame.
std::vector<double> movieTimes(const ViewSource& source, const ViewMovieOptions& options);

/// Returns the number of video frames; 0 after a stop by `progress`, without output.
int writeMovie(ViewSource& source, const ViewMovieOptions& options, const Progress& progress);

}  // namespace softscope
