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
  /// The source must outlive it. Throws OptionError below 320 x 240 or above 4096 pixels, and
  /// BackendError where nothing renders. `clean`: the view alone, without slider and words.
  ViewPicture(ViewSource& source, int width_px, int height_px, bool clean = false);

  /// `turn_deg`: further about what is looked at. Throws InputError where the moment can't be read.
  ColourImage draw(const Playback& playback, const ViewState& state, double turn_deg);

 private:
  ViewSource& source_;
  double foot_scale_;         // 0: there is none
  int width_px_, height_px_;  // of the part above the foot
  ViewScene scene_;
  vtkSmartPointer<vtkRenderWindow> window_;
  std::shared_ptr<const ViewMoment> first_;  // standard looks follow the first moment drawn
};

/// Throws OptionError where a viewer can't be that large.
void requireViewSize(int width_px, int height_px);

}  // namespace softscope
