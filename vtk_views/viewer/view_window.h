// vtk_views/viewer/view_window.h: the viewer's window: plays, turns, follows a live run.
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
  int first = 0;         // the moment shown at first
  bool playing = false;  // from the start
  double speed = 1;
  std::function<void(const ColourImage&, int frame)> save;  // a screenshot
  std::function<bool()> closes = [] { return false; };      // asked all the time
};

/// How fast the window drew.
struct ViewPace {
  int pictures = 0;
  double seconds = 0;  // that drawing took, reading models included
};

class ViewWindow {
 public:
  /// Opens the window and draws. The source must outlive it. Throws BackendError without a display,
  /// InputError where the first moment can't be read.
  ViewWindow(ViewSource& source, ViewWindowOptions options);
  ~ViewWindow();

  /// Until the user closes it. Throws what went wrong meanwhile.
  void run();

  /// As it is on screen.
  ColourImage pixels() const;
  ViewPace pace() const;

  // Keys without a keyboard, for tests.
  vtkRenderWindowInteractor* interactor();
  const Playback& playback() const;
  const ViewState& state() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace softscope
