// toolkit/viewer/show_run.cpp: checks, frames and output files.
#include "toolkit/viewer/show_run.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/images/image_writer.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "vtk_views/viewer/view_picture.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// Width and height. Throws OptionError.
std::pair<int, int> parseViewSize(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto width = numberOf(text.substr(0, cross));
  const auto height = cross == std::string::npos ? width : numberOf(text.substr(cross + 1));
  if (cross == std::string::npos || !width || !height || *width != std::floor(*width) ||
      *height != std::floor(*height) ||
      !(*width > 0 && *width < 1e5 && *height > 0 && *height < 1e5))
    throw OptionError("`size=` is `" + text + "`, but must be WIDTHxHEIGHT, e.g. 960x720");
  const std::pair<int, int> size{static_cast<int>(*width), static_cast<int>(*height)};
  requireViewSize(size.first, size.second);
  return size;
}

template <class Value>
Value named(const std::string& setting, const std::string& name,
            const std::vector<std::pair<std::string, Value>>& values) {
  std::string all;
  for (const auto& [known, value] : values) {
    if (known == name) return value;
    all += (all.empty() ? "" : ", ") + known;
  }
  throw OptionError(setting + " is `" + name + "`, but must be one of " + all);
}

void validateMovie(const ViewMovieOptions& movie) {
  require(movie.frames_per_second >= 1 && movie.frames_per_second <= 120, "`frames_per_second=`",
          movie.frames_per_second, "must be 1 to 120");
  require(movie.speed > 0 && movie.speed <= 1000, "`speed=`", movie.speed,
          "must be above 0, at most 1000");
  require(movie.seconds >= 0 && movie.seconds <= 3600, "`seconds=`", movie.seconds,
          "must be 0 to 3600");
  require(std::abs(movie.turn_deg) <= 36000, "`turn_deg=`", movie.turn_deg,
          "must be -36000 to 36000 degrees");
}

}  // namespace

int ViewRequest::widthPx() const { return parseViewSize(size).first; }
int ViewRequest::heightPx() const { return parseViewSize(size).second; }

ViewState ViewRequest::state() const {
  ViewState state;
  state.colour = named<ViewColour>("`colour=`", colour,
                                   {{"texture", ViewColour::kTexture},
                                    {"errors", ViewColour::kErrors},
                                    {"weights", ViewColour::kWeights}});
  state.look = named<Look>("`look=`", look,
                           {{"free", Look::kFree},
                            {"scope", Look::kScope},
                            {"front", Look::kFront},
                            {"above", Look::kAbove},
                            {"right", Look::kRight}});
  state.nodes = nodes;
  state.motion = arrows;
  state.scope = !no_scope;
  return state;
}

void ViewRequest::validate() const {
  const int width_px = widthPx(), height_px = heightPx();
  run.errors.validate();
  const ViewColour chosen = state().colour;
  if (run.errors.kind == "none") throw OptionError("`errors=` must be absolute or signed");
  require(frame >= -1, "`frame=`", frame, "must be 0 or more");
  validateMovie(movie);
  if (movie.clean && opensWindow())
    throw OptionError("`clean=` is for `screenshot=` and `movie=`; a window needs its slider");
  if (chosen == ViewColour::kErrors && run.reference.empty() && run.evaluation.empty())
    throw OptionError("`colour=` errors needs `reference=` or `evaluation=` to take errors from");
  if (!run.ct_from_run.empty() && run.ct.empty() && run.reference.empty())
    throw OptionError("`ct_from_run=` needs `ct=` or `reference=` as its target");
  if (!screenshot.empty()) {
    if (fs::path(screenshot).extension() != ".png")
      throw OptionError("`screenshot=` is `" + screenshot + "`, but must end in .png");
    requireWritable(screenshot, overwrite);
  }
  if (!movie.file.empty()) requireWritable(movie.file, overwrite);
  if (!movie.file.empty() && (width_px % 2 != 0 || height_px % 2 != 0))
    throw OptionError("`size=` is `" + size + "`, but a movie's width and height must be even");
}

/// Last saved frame at or before `frame`.
int ViewRequest::firstMoment(const ViewSource& source, bool last_by_default) const {
  if (frame < 0) return last_by_default ? source.count() - 1 : 0;
  if (frame < source.frameOf(0) || frame > source.frameOf(source.count() - 1))
    throw OptionError(say("`frame=` is ", frame, ", but ", run.run, " has models of frames ",
                          source.frameOf(0), " to ", source.frameOf(source.count() - 1)));
  int index = 0;
  while (index + 1 < source.count() && source.frameOf(index + 1) <= frame) ++index;
  return index;
}

void waitForModel(const std::string& run, const std::function<bool()>& stopped,
                  const WorkListener& listener) {
  bool reported = false;
  while (!stopped()) {
    if (fs::is_directory(run) && !findModelsOnDisk(run, {}).empty()) return;
    if (!reported) listener.tell("waiting for the first model in " + run);
    reported = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

std::vector<std::string> viewWarnings(const ViewRequest& request, const RunSource& source) {
  const std::string& run = request.run.run;
  const ViewState state = request.state();
  std::vector<std::string> warnings = source.warnings();
  if (source.stopped())
    warnings.push_back(run + ": stopped before its end; the existing models are shown");
  if ((request.nodes || request.arrows) && !source.world().has_nodes && !source.live())
    warnings.push_back(run +
                       ": no nodes were saved with its models; reconstruct it again to show them");
  if (state.colour == ViewColour::kWeights && !source.world().has_weights)
    warnings.push_back(run + ": its models carry no weights");
  if (state.look == Look::kScope && source.world().left.width_px == 0)
    warnings.push_back(run + ": the camera is unknown; shown with a free view");
  return warnings;
}

WrittenView writeView(const ViewRequest& request, RunSource& source, const WorkListener& listener) {
  WrittenView written;
  written.record = {{"schema_version", 1}, {"run", request.run.run}, {"models", source.count()}};
  if (!request.screenshot.empty()) {
    Playback playback(source);
    playback.goTo(request.firstMoment(source, true));
    ViewPicture picture(source, request.widthPx(), request.heightPx(), request.movie.clean);
    writePng(request.screenshot, picture.draw(playback, request.state(), request.movie.turn_deg),
             request.overwrite);
    written.record["screenshot"] = {{"file", request.screenshot},
                                    {"frame", source.frameOf(playback.index())}};
    listener.tell("written: " + request.screenshot);
  }
  if (request.movie.file.empty()) return written;
  ViewMovieOptions movie = request.movie;
  movie.width_px = request.widthPx();
  movie.height_px = request.heightPx();
  movie.state = request.state();
  movie.overwrite = request.overwrite;
  const int frames = writeMovie(source, movie, listener.progress);
  written.interrupted = frames == 0;
  if (written.interrupted) return written;
  written.record["movie"] = {{"file", movie.file.string()}, {"frames", frames}};
  listener.tell("written: " + movie.file.string());
  return written;
}

std::string saveViewPicture(const ColourImage& picture, int frame) {
  for (int number = 1; number < 1000; ++number) {
    const std::string end = number == 1 ? ".png" : say("_", number, ".png");
    const std::string name = "view_" + numberedName(frame, end);
    if (fs::exists(name)) continue;
    writePng(name, picture);
    return name;
  }
  return "";
}

}  // namespace softscope
