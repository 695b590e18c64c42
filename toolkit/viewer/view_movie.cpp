// toolkit/viewer/view_movie.cpp: moments by the clip's clock, one picture a video frame.
#include "toolkit/viewer/view_movie.h"

#include <cmath>

#include "io/images/video_writer.h"
#include "vtk_views/viewer/view_picture.h"

namespace softscope {
namespace {

constexpr double kTurnOfOne_s = 8;  // a single model that is only turned

double movieSeconds(const ViewSource& source, const ViewMovieOptions& options) {
  if (options.seconds > 0) return options.seconds;
  if (source.count() == 1 && options.turn_deg != 0) return kTurnOfOne_s;
  return (endSeconds(source) - source.secondsOf(0)) / options.speed;
}

}  // namespace

std::vector<int> movieMoments(const ViewSource& source, const ViewMovieOptions& options) {
  const double clip_s = endSeconds(source) - source.secondsOf(0);
  const double movie_s = movieSeconds(source, options);
  const auto count = std::max<long>(1, std::lround(movie_s * options.frames_per_second));
  std::vector<int> moments;
  int index = 0;
  for (long k = 0; k < count; ++k) {
    // A little later than the frame begins: rounding must not show the moment before.
    const double at_s = source.secondsOf(0) + (double(k) + 1e-3) / double(count) * clip_s;
    while (index + 1 < source.count() && source.secondsOf(index + 1) <= at_s) ++index;
    moments.push_back(index);
  }
  return moments;
}

int writeMovie(ViewSource& source, const ViewMovieOptions& options, const Progress& progress) {
  const std::vector<int> moments = movieMoments(source, options);
  ViewPicture picture(source, options.width_px, options.height_px, options.clean);
  VideoWriter video(options.file, options.width_px, options.height_px, options.frames_per_second,
                    options.overwrite);
  const auto count = static_cast<int>(moments.size());
  Playback playback(source);
  playback.playing = true;  // as the foot says
  playback.speed = options.speed;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    if (!goesOn(progress, static_cast<int>(k), count)) return 0;
    playback.goTo(moments[k]);
    const double turned_deg = options.turn_deg * double(k) / double(moments.size());
    video.add(picture.draw(playback, options.state, turned_deg));
  }
  goesOn(progress, count, count);
  video.finish();
  return static_cast<int>(moments.size());
}

}  // namespace softscope
