// vtk_views/viewer/view_window.h: interactive window with playback and live update.
#pragma once

#include <vtkRenderWindowInteractor.h>

#include <functional>
#include <memory>

#include "core/image.h"
#include "vtk_views/viewer/view_controls.h"
#include "vtk_views/viewer/view_source.h"

namespace softscope {

struct ViewWindowOptions {
  int width_px = 960, height_px = 720;
  ViewState state;
  int first = 0;         // index of the first model
  bool playing = false;  // from the start
  double speed = 1;
  std::function<void(const ColourImage&, int frame)> save;  // a screenshot
  std::function<bool()> closes = [] { return false; };      // polled during the event loop
};

/// Drawing speed of the window.
struct ViewPace {
  int pictures = 0;
  double seconds = 0;  // drawing time, including reading of models
};

class ViewWindow {
 public:
  /// Opens the window and draws. The source must outlive it. Throws
  /// BackendError without a display, InputError for an unreadable first model.
  ViewWindow(ViewSource& source, ViewWindowOptions options);
  ~ViewWindow();

  /// Runs until the user closes it. Rethrows exceptions of the event loop.
  void run();

  /// Content of the screen.
  ColourImage pixels() const;
  ViewPace pace() const;

  // For simulated keys in tests.
  vtkRenderWindowInteractor* interactor();
  const Playback& playback() const;
  const ViewState& state() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace softscope
