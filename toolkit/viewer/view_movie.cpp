// toolkit/viewer/view_movie.cpp: clip time and image of each video frame.
#include "toolkit/viewer/view_movie.h"

#include <cmath>

#include "io/images/video_writer.h"
#include "vtk_views/viewer/view_picture.h"

namespace softscope {
namespace {

constexpr double kTurnOfOne_s = 8;  // duration for a single model

double movieSeconds(const ViewSource& source, const ViewMovieOptions& options) {
  if (options.seconds > 0) return options.seconds;
  if (source.count() == 1 && options.turn_deg != 0) return kTurnOfOne_s;
  return (endSeconds(source) - source.secondsOf(0)) / options.speed;
}

}  // namespace

std::vector<double> movieTimes(const ViewSource& source, const ViewMovieOptions& options) {
  const double clip_s = endSeconds(source) - source.secondsOf(0);
  const double movie_s = movieSeconds(source, options);
  const auto count = std::max<long>(1, std::lround(movie_s * options.frames_per_second));
  std::vector<double> times;
  // Shifted slightly after the start of the frame: rounding must not select the previous one.
  for (long k = 0; k < count; ++k)
    times.push_back(source.secondsOf(0) + (double(k) + 1e-3) / double(count) * clip_s);
  return times;
}

int writeMovie(ViewSource& source, const ViewMovieOptions& options, const Progress& progress) {
  const std::vector<double> times = movieTimes(source, options);
  ViewPicture picture(source, options.width_px, options.height_px, options.clean);
  VideoWriter video(options.file, options.width_px, options.height_px, options.frames_per_second,
                    options.overwrite);
  const auto count = static_cast<int>(times.size());
  ViewState state = options.state;
  state.turning = options.turn_deg != 0;
  Playback playback(source);
  playback.playing = true;  // as shown in the foot line
  playback.speed = options.speed;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!reportProgress(progress, static_cast<int>(k), count)) return 0;
    playback.goToTime(times[k]);
    const double turned_deg = options.turn_deg * double(k) / double(times.size());
    video.add(picture.draw(playback, state, turned_deg));
  }
  reportProgress(progress, count, count);
  video.finish();
  return static_cast<int>(times.size());
}

}  // namespace softscope
