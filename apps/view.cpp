// apps/view.cpp: `softscope view`: a run in a window, an image or a movie.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "apps/work_progress.h"
#include "toolkit/viewer/show_run.h"
#include "vtk_views/viewer/view_window.h"
#include "vtk_views/viewer/x_display.h"

namespace softscope {
namespace {

const char* const kViewDetails =
    "Shows the models saved by `reconstruct` (--save-every) over time, with the scope, its path,\n"
    "the nodes of the warp and their motion. New models of a running reconstruction appear as "
    "they\n"
    "are written. With --reference (a mesh, or the sequence with its truth) or --evaluation the\n"
    "model is coloured by its errors; with --ct slices are drawn below it.\n"
    "--screenshot and --movie need no display; without them a window opens.\n"
    "Parallel projection with a scale bar, as in figures; the view of the scope is in perspective.";

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
    return "interactive view of a run, also during reconstruction; screenshots and movies";
  }
  std::string details() const override { return kViewDetails + keysText(); }
  std::string example() const override {
    return "softscope view run\n"
           "  softscope view run --reference clip --colour errors --screenshot last.png\n"
           "  softscope view run --movie run.mp4 --turn 60 --seconds 12";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  void openWindow(RunSource& source) const;
  int writeFiles(RunSource& source) const;

  ViewRequest request_;
  std::string movie_file_;
  bool play_ = false, wait_ = false;
};

void ViewCommand::declare(ArgumentList& arguments) {
  arguments.positional("RUN", request_.run.run,
                       "folder written by reconstruct, finished or running", true);
  arguments.option("--colour", "NAME", request_.colour, "texture (default), errors or weights");
  arguments.option("--look", "NAME", request_.look, "free (default), scope, front, above or right");
  arguments.flag("--nodes", request_.nodes, "show the nodes of the warp");
  arguments.flag("--arrows", request_.arrows,
                 "show the motion of the nodes since the previous model");
  arguments.flag("--no-scope", request_.no_scope, "hide the scope and its path");
  arguments.option("--reference", "PATH", request_.run.reference,
                   "mesh to compare, or the sequence with its truth");
  arguments.option("--evaluation", "DIR", request_.run.evaluation,
                   "errors measured by `evaluate --out DIR`");
  arguments.option("--errors", "KIND", request_.run.errors.kind, "absolute (default) or signed");
  arguments.option("--range-mm", "N", request_.run.errors.range_mm,
                   "end of the colour bar (default: a round number, at least the P95)");
  arguments.option("--ct", "VOLUME", request_.run.ct,
                   "slices of a DICOM folder, NIfTI, NRRD, MetaImage");
  softscope::declare(request_.run.volume, arguments);
  arguments.option("--ct-from-run", "FILE", request_.run.ct_from_run,
                   "transform into the CT: 4 x 4 numbers, or evaluation.json of --align rigid");
  arguments.option("--window", "NAME", request_.run.window,
                   "grey window of the CT: auto (default), "
                   "soft-tissue, lung, bone, liver, vessels, or WIDTH,LEVEL");
  arguments.option("--frame", "N", request_.frame,
                   "start at this frame, or at the last one saved before it");
  arguments.option("--screenshot", "FILE", request_.screenshot, "write a PNG, open no window");
  arguments.option("--movie", "FILE", movie_file_, "write a video (mp4), open no window");
  arguments.option("--size", "WxH", request_.size, "in pixels (default 960x720)");
  arguments.option("--fps", "N", request_.movie.frames_per_second, "of the movie (default 25)");
  arguments.option("--speed", "N", request_.movie.speed,
                   "seconds of the clip per second (default 1)");
  arguments.option("--seconds", "N", request_.movie.seconds,
                   "length of the movie; overrides the speed");
  arguments.option("--turn", "DEG", request_.movie.turn_deg,
                   "total rotation of the camera in the movie");
  arguments.flag("--clean", request_.movie.clean, "a screenshot or movie without slider and texts");
  arguments.flag("--play", play_, "play at once");
  arguments.flag("--wait", wait_, "wait for the first model of a new run");
  arguments.flag("--force", request_.overwrite, "overwrite an existing screenshot or movie");
}

void ViewCommand::openWindow(RunSource& source) const {
  const InterruptGuard interrupt;
  ViewWindowOptions options;
  options.width_px = request_.widthPx();
  options.height_px = request_.heightPx();
  options.state = request_.state();
  options.first = request_.firstMoment(source, source.live());
  options.playing = play_;
  options.speed = request_.movie.speed;
  options.save = [](const ColourImage& picture, int frame) {
    if (const std::string file = saveViewPicture(picture, frame); !file.empty())
      spdlog::info("written: {}", file);
  };
  options.closes = [&interrupt] { return interrupt.requested(); };
  ViewWindow window(source, std::move(options));
  spdlog::debug("the window is open");
  window.run();
  const ViewPace pace = window.pace();
  spdlog::debug("{} images, {:.1f} ms each", pace.pictures,
                1000 * pace.seconds / std::max(pace.pictures, 1));
}

int ViewCommand::writeFiles(RunSource& source) const {
  const InterruptGuard interrupt;
  WorkProgress progress("movie", progressStyle(common.quiet), interrupt);
  const WrittenView written = writeView(request_, source, listenerOf(progress));
  if (written.interrupted) return kInterrupted;
  if (common.json) printJson(written.record);
  return kDone;
}

int ViewCommand::run() {
  request_.movie.file = movie_file_;
  request_.validate();
  std::shared_ptr<void> display;
  if (request_.opensWindow()) display = connectToDisplay();  // before any reading
  if (wait_) {
    const InterruptGuard interrupt;
    waitForModel(
        request_.run.run, [&] { return interrupt.requested(); }, logListener());
  }
  RunSource source(request_.run);
  for (const std::string& warning : viewWarnings(request_, source)) spdlog::warn("{}", warning);
  if (!request_.opensWindow()) return writeFiles(source);
  openWindow(source);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeViewCommand() { return std::make_unique<ViewCommand>(); }

}  // namespace softscope
