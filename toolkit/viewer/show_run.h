// toolkit/viewer/show_run.h: window, image or movie of a run.
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
  ViewMovieOptions movie;          // without a file: none; speed and turn apply to all outputs
  std::string size = "960x720";    // in pixels
  std::string colour = "texture";  // or errors, weights
  std::string look = "free";       // or scope, front, above, right
  int frame = -1;                  // initial frame, or the last saved frame before it
  bool nodes = false, arrows = false, no_scope = false;
  bool overwrite = false;

  /// True without screenshot and movie.
  bool opensWindow() const { return screenshot.empty() && movie.file.empty(); }
  /// Throws OptionError.
  void validate() const;

  int widthPx() const;
  int heightPx() const;
  ViewState state() const;
  /// Index of the initial model. Throws OptionError for a missing frame.
  int firstMoment(const ViewSource& source, bool last_by_default) const;
};

/// Waits until the run has a model, or until `stopped`.
void waitForModel(const std::string& run, const std::function<bool()>& stopped,
                  const WorkListener& listener = {});

/// Requested content that cannot be shown, and warnings of the source.
std::vector<std::string> viewWarnings(const ViewRequest& request, const RunSource& source);

struct WrittenView {
  FactSheet::Json record;
  bool interrupted = false;  // then no movie was written
};

/// Writes the screenshot and the movie. `listener.progress` counts the frames of the movie.
WrittenView writeView(const ViewRequest& request, RunSource& source,
                      const WorkListener& listener = {});

/// view_000038.png in the current folder, or the next
/// unused name. Returns it; empty if there is none.
std::string saveViewPicture(const ColourImage& picture, int frame);

}  // namespace softscope
