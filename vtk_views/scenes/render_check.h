// vtk_views/scenes/render_check.h: test of off-screen rendering on this machine.
#pragma once

#include <string>

namespace softscope {

struct RenderCheck {
  bool works = false;
  std::string renderer;  // text of the driver; empty without a renderer
  std::string problem;   // reason of the failure; empty on success
  double first_frame_ms = 0;
};

/// Renders an orange square on blue off-screen and reads it back. Never throws.
RenderCheck checkRendering();

}  // namespace softscope
