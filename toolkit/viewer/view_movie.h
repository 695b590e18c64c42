// toolkit/viewer/view_movie.h: a run as a video, without a display.
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
  double speed = 1;     // seconds of the clip a second
  double seconds = 0;   // how long the video is; 0: as long as the clip at that speed
  double turn_deg = 0;  // by which the camera turns about the model, all in all
  ViewState state;
  bool clean = false;  // without slider and words
  bool overwrite = false;
};

/// The time of the clip that each of the video's frames shows.
std::vector<double> movieTimes(const ViewSource& source, const ViewMovieOptions& options);

/// Returns how many frames the video has; 0 where `progress` stopped it, and nothing is written.
int writeMovie(ViewSource& source, const ViewMovieOptions& options, const Progress& progress);

}  // namespace softscope
