// toolkit/viewer/show_run.h: what the viewer shows of a run, in a window, an image or a movie.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/image.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/viewer/view_movie.h"
#include "toolkit/viewer/view_run.h"

namespace softscope {

struct ViewRequest {
  ViewRunOptions run;
  std::string screenshot;          // PNG; empty: none
  ViewMovieOptions movie;          // without a file: none; speed and turn hold for all
  std::string size = "960x720";    // in pixels
  std::string colour = "texture";  // or errors, weights
  std::string look = "free";       // or scope, front, above, right
  int frame = -1;                  // begin with it, or the last one saved before it
  bool nodes = false, arrows = false, no_scope = false;
  bool overwrite = false;

  /// Neither a screenshot nor a movie.
  bool opensWindow() const { return screenshot.empty() && movie.file.empty(); }
  /// Throws OptionError.
  void validate() const;

  int widthPx() const;
  int heightPx() const;
  ViewState state() const;
  /// The moment to begin with. Throws OptionError for a frame that the source has not.
  int firstMoment(const ViewSource& source, bool last_by_default) const;
};

/// Until the run has a model, or `stopped`.
void waitForModel(const std::string& run, const std::function<bool()>& stopped,
                  const WorkListener& listener = {});

/// What was asked for and can't be shown, and what the source warns of.
std::vector<std::string> viewWarnings(const ViewRequest& request, const RunSource& source);

struct WrittenView {
  FactSheet::Json record;
  bool interrupted = false;  // then there is no movie
};

/// The screenshot and the movie. `listener.progress` counts the movie's frames.
WrittenView writeView(const ViewRequest& request, RunSource& source,
                      const WorkListener& listener = {});

/// view_000038.png in the current folder, or the next free name. Returns it; empty where there is
/// none.
std::string saveViewPicture(const ColourImage& picture, int frame);

}  // namespace softscope
