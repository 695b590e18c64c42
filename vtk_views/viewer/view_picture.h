// vtk_views/viewer/view_picture.h: content of the viewer's window, rendered off screen.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include "core/image.h"
#include "vtk_views/viewer/view_controls.h"
#include "vtk_views/viewer/view_scene.h"

namespace softscope {

class ViewPicture {
 public:
  /// The source must outlive it. Throws OptionError below 320 x 240 or above 4096
  /// pixels, and BackendError without a renderer. `clean`: without slider and texts.
  ViewPicture(ViewSource& source, int width_px, int height_px, bool clean = false);

  /// `turn_deg`: additional rotation about the model. Throws InputError for an unreadable model.
  ColourImage draw(const Playback& playback, const ViewState& state, double turn_deg);

 private:
  ViewSource& source_;
  double foot_scale_;         // 0: without foot
  int width_px_, height_px_;  // without the foot
  ViewScene scene_;
  vtkSmartPointer<vtkRenderWindow> window_;
  std::shared_ptr<const ViewMoment> first_;  // standard views are relative to the first model
};

/// Throws OptionError for an unsupported size.
void requireViewSize(int width_px, int height_px);

}  // namespace softscope
