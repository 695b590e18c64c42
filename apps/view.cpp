// apps/view.cpp: `softscope view`: a run in a window, a picture or a movie.
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/images/image_writer.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/viewer/view_movie.h"
#include "toolkit/viewer/view_run.h"
#include "vtk_views/viewer/view_picture.h"
#include "vtk_views/viewer/view_window.h"
#include "vtk_views/viewer/x_display.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

const char* const kDetails =
    "Shows the models that `reconstruct` saved (--save-every), one after the other, with the "
    "scope,\n"
    "its path, the nodes of the warp and how they moved. A run that still goes on is followed: "
    "its\n"
    "new models appear as they are written. With --reference (a mesh, or the sequence with its\n"
    "truth) or --evaluation the model is coloured by its errors; with --ct slices lie under it.\n"
    "--screenshot and --movie need no display; without them a window opens.\n"
    "Drawn as the figures are: parallel, with a scale bar; the scope's own view is in perspective.";

std::string keysText() {
  std::string text = "\n\nKeys of the window:\n";
  for (const auto& [keys, meaning] : viewKeys()) {
    std::string line = "  " + keys;
    line.append(line.size() < 20 ? 20 - line.size() : 1, ' ');
    text += line + meaning + "\n";
  }
  text.pop_back();
  return text;
}

class ViewCommand : public Command {
 public:
  std::string name() const override { return "view"; }
  std::string summary() const override {
    return "a run in a window, also while it is made; screenshots and movies";
  }
  std::string details() const override { return kDetails + keysText(); }
  std::string example() const override {
    return "softscope view run\n"
           "  softscope view run --reference clip --colour errors --screenshot last.png\n"
           "  softscope view run --movie run.mp4 --turn 60 --seconds 12";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  void validate();
  void parseSize();
  void waitForModel() const;
  void warnOfMissing(const RunSource& source) const;
  int firstMoment(const ViewSource& source, bool last_by_default) const;
  void writeScreenshot(RunSource& source, Json& record) const;
  int openWindow(RunSource& source) const;
  int makeMovie(ViewSource& source) const;
  void saveFromWindow(const ColourImage& picture, int frame) const;

  ViewRunOptions run_;
  ViewMovieOptions movie_;
  std::string screenshot_, movie_file_, size_ = "960x720", colour_ = "texture", look_ = "free";
  int frame_ = -1, width_px_ = 960, height_px_ = 720;
  bool nodes_ = false, arrows_ = false, no_scope_ = false, play_ = false, wait_ = false,
       force_ = false;
  ViewState state_;
};

void ViewCommand::declare(ArgumentList& arguments) {
  arguments.positional("RUN", run_.run, "folder that reconstruct wrote, or still writes", true);
  arguments.option("--colour", "NAME", colour_, "texture (default), errors or weights");
  arguments.option("--look", "NAME", look_, "free (default), scope, front, above or right");
  arguments.flag("--nodes", nodes_, "show the nodes of the warp");
  arguments.flag("--arrows", arrows_, "show how the nodes moved since the model before");
  arguments.flag("--no-scope", no_scope_, "hide the scope and its path");
  arguments.option("--reference", "PATH", run_.reference,
                   "mesh to show with it, or the sequence with its truth");
  arguments.option("--evaluation", "DIR", run_.evaluation,
                   "errors that `evaluate --out DIR` measured");
  arguments.option("--errors", "KIND", run_.errors.kind, "absolute (default) or signed");
  arguments.option("--range-mm", "N", run_.errors.range_mm,
                   "end of the colour bar (default: a round number, not below the P95)");
  arguments.option("--ct", "VOLUME", run_.ct, "slices of a DICOM folder, NIfTI, NRRD, MetaImage");
  softscope::declare(run_.volume, arguments);
  arguments.option("--ct-from-run", "FILE", run_.ct_from_run,
                   "motion into the CT: 4 x 4 numbers, or evaluation.json of --align rigid");
  arguments.option("--window", "NAME", run_.window,
                   "grey window of the CT: auto (default), "
                   "soft-tissue, lung, bone, liver, vessels, or WIDTH,LEVEL");
  arguments.option("--frame", "N", frame_,
                   "begin with this frame, or the last one saved before it");
  arguments.option("--screenshot", "FILE", screenshot_, "write a PNG, open no window");
  arguments.option("--movie", "FILE", movie_file_, "write a video (mp4), open no window");
  arguments.option("--size", "WxH", size_, "in pixels (default 960x720)");
  arguments.option("--fps", "N", movie_.frames_per_second, "of the movie (default 25)");
  arguments.option("--speed", "N", movie_.speed, "seconds of the clip a second (default 1)");
  arguments.option("--seconds", "N", movie_.seconds, "length of the movie, whatever the speed");
  arguments.option("--turn", "DEG", movie_.turn_deg, "turn the camera in the movie, all in all");
  arguments.flag("--clean", movie_.clean, "a screenshot or movie without slider and words");
  arguments.flag("--play", play_, "play at once");
  arguments.flag("--wait", wait_, "wait for the first model of a run that has just begun");
  arguments.flag("--force", force_, "overwrite a screenshot or movie that is there");
}

void ViewCommand::parseSize() {
  const std::size_t cross = size_.find('x');
  const auto width = numberOf(size_.substr(0, cross));
  const auto height = cross == std::string::npos ? width : numberOf(size_.substr(cross + 1));
  if (cross == std::string::npos || !width || !height || *width != std::floor(*width) ||
      *height != std::floor(*height) ||
      !(*width > 0 && *width < 1e5 && *height > 0 && *height < 1e5))
    throw OptionError("--size is `" + size_ + "`, but must be WIDTHxHEIGHT, e.g. 960x720");
  width_px_ = static_cast<int>(*width);
  height_px_ = static_cast<int>(*height);
  requireViewSize(width_px_, height_px_);
}

template <class Value>
Value named(const std::string& option, const std::string& name,
            const std::vector<std::pair<std::string, Value>>& values) {
  std::string all;
  for (const auto& [known, value] : values) {
    if (known == name) return value;
    all += (all.empty() ? "" : ", ") + known;
  }
  throw OptionError(option + " is `" + name + "`, but must be one of " + all);
}

void ViewCommand::validate() {
  parseSize();
  run_.errors.validate();
  state_.colour = named<ViewColour>("--colour", colour_,
                                    {{"texture", ViewColour::kTexture},
                                     {"errors", ViewColour::kErrors},
                                     {"weights", ViewColour::kWeights}});
  state_.look = named<Look>("--look", look_,
                            {{"free", Look::kFree},
                             {"scope", Look::kScope},
                             {"front", Look::kFront},
                             {"above", Look::kAbove},
                             {"right", Look::kRight}});
  state_.nodes = nodes_;
  state_.motion = arrows_;
  state_.scope = !no_scope_;
  if (run_.errors.kind == "none") throw OptionError("--errors must be absolute or signed");
  require(frame_ >= -1, "--frame", frame_, "must be 0 or more");
  require(movie_.frames_per_second >= 1 && movie_.frames_per_second <= 120, "--fps",
          movie_.frames_per_second, "must be 1 to 120");
  if (movie_.clean && screenshot_.empty() && movie_file_.empty())
    throw OptionError("--clean is for --screenshot and --movie; a window needs its slider");
  require(movie_.speed > 0 && movie_.speed <= 1000, "--speed", movie_.speed,
          "must be above 0, at most 1000");
  require(movie_.seconds >= 0 && movie_.seconds <= 3600, "--seconds", movie_.seconds,
          "must be 0 to 3600");
  require(std::abs(movie_.turn_deg) <= 36000, "--turn", movie_.turn_deg,
          "must be -36000 to 36000 degrees");
  if (state_.colour == ViewColour::kErrors && run_.reference.empty() && run_.evaluation.empty())
    throw OptionError("--colour errors needs --reference or --evaluation to take errors from");
  if (!run_.ct_from_run.empty() && run_.ct.empty() && run_.reference.empty())
    throw OptionError("--ct-from-run needs --ct or --reference, which it leads to");
  if (!screenshot_.empty()) requireWritable(screenshot_, force_);
  if (!movie_file_.empty()) requireWritable(movie_file_, force_);
  if (!movie_file_.empty() && (width_px_ % 2 != 0 || height_px_ % 2 != 0))
    throw OptionError("--size is `" + size_ + "`, but a movie's width and height must be even");
}

void ViewCommand::waitForModel() const {
  const InterruptGuard interrupt;
  bool told = false;
  while (!interrupt.requested()) {
    if (fs::is_directory(run_.run) && !findModelsOnDisk(run_.run, {}).empty()) return;
    if (!told) spdlog::info("waiting for the first model in {}", run_.run);
    told = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

void ViewCommand::warnOfMissing(const RunSource& source) const {
  for (const std::string& warning : source.warnings()) spdlog::warn("{}", warning);
  if (source.stopped())
    spdlog::warn("{}: stopped before its end; what it wrote until then is shown", run_.run);
  if ((nodes_ || arrows_) && !source.world().has_nodes && !source.live())
    spdlog::warn("{}: no nodes were saved with its models; reconstruct it again to see them",
                 run_.run);
  if (state_.colour == ViewColour::kWeights && !source.world().has_weights)
    spdlog::warn("{}: its models carry no weights", run_.run);
  if (state_.look == Look::kScope && source.world().left.width_px == 0)
    spdlog::warn("{}: nothing tells what the scope sees; shown freely", run_.run);
}

/// The last moment that isn't after --frame.
int ViewCommand::firstMoment(const ViewSource& source, bool last_by_default) const {
  if (frame_ < 0) return last_by_default ? source.count() - 1 : 0;
  if (frame_ < source.frameOf(0) || frame_ > source.frameOf(source.count() - 1))
    throw OptionError(say("--frame is ", frame_, ", but ", run_.run, " has models of frames ",
                          source.frameOf(0), " to ", source.frameOf(source.count() - 1)));
  int index = 0;
  while (index + 1 < source.count() && source.frameOf(index + 1) <= frame_) ++index;
  return index;
}

void ViewCommand::writeScreenshot(RunSource& source, Json& record) const {
  Playback playback(source);
  playback.goTo(firstMoment(source, true));
  ViewPicture picture(source, width_px_, height_px_, movie_.clean);
  writePng(screenshot_, picture.draw(playback, state_, movie_.turn_deg), force_);
  record["screenshot"] = {{"file", screenshot_}, {"frame", source.frameOf(playback.index())}};
  spdlog::info("written: {}", screenshot_);
}

/// view_000038.png where the user stands, or the next free name.
void ViewCommand::saveFromWindow(const ColourImage& picture, int frame) const {
  for (int number = 1; number < 1000; ++number) {
    const std::string end = number == 1 ? ".png" : say("_", number, ".png");
    const std::string name = "view_" + numberedName(frame, end);
    if (fs::exists(name)) continue;
    writePng(name, picture);
    spdlog::info("written: {}", name);
    return;
  }
}

int ViewCommand::openWindow(RunSource& source) const {
  const InterruptGuard interrupt;
  ViewWindowOptions options;
  options.width_px = width_px_;
  options.height_px = height_px_;
  options.state = state_;
  options.first = firstMoment(source, source.live());
  options.playing = play_;
  options.speed = movie_.speed;
  options.save = [this](const ColourImage& picture, int frame) { saveFromWindow(picture, frame); };
  options.closes = [&interrupt] { return interrupt.requested(); };
  ViewWindow window(source, std::move(options));
  spdlog::debug("the window is open");
  window.run();
  const ViewPace pace = window.pace();
  spdlog::debug("{} pictures, {:.1f} ms each", pace.pictures,
                1000 * pace.seconds / std::max(pace.pictures, 1));
  return kDone;
}

int ViewCommand::makeMovie(ViewSource& source) const {
  const InterruptGuard interrupt;
  WorkProgress progress("movie", progressStyle(common.quiet), interrupt);
  return writeMovie(source, movie_, progress.callback());
}

int ViewCommand::run() {
  validate();
  const bool with_window = screenshot_.empty() && movie_file_.empty();
  std::shared_ptr<void> display;
  if (with_window) display = connectToDisplay();  // asked before everything is read
  if (wait_) waitForModel();
  RunSource source(run_);
  warnOfMissing(source);
  if (with_window) return openWindow(source);
  Json record{{"run", run_.run}, {"models", source.count()}};
  if (!screenshot_.empty()) writeScreenshot(source, record);
  if (!movie_file_.empty()) {
    movie_.file = movie_file_;
    movie_.width_px = width_px_;
    movie_.height_px = height_px_;
    movie_.state = state_;
    movie_.overwrite = force_;
    const int frames = makeMovie(source);
    if (frames == 0) return kInterrupted;
    record["movie"] = {{"file", movie_file_}, {"frames", frames}};
    spdlog::info("written: {}", movie_file_);
  }
  if (common.json) printJson(record);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeViewCommand() { return std::make_unique<ViewCommand>(); }

}  // namespace softscope
