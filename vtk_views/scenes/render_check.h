// vtk_views/scenes/render_check.h: test of off-screen rendering on this machine.
#pragma once

#include <string>

namespace softscope {

struct RenderCheck {
  bool works = false;
  std::string renderer;  // the driver's own words; empty where there is none
  std::string problem;   // why it doesn't work; empty where it does
  double first_frame_ms = 0;
};

/// Draws an orange square on blue, off screen, and reads the pixels back. Never throws.
RenderCheck checkRendering();

}  // namespace softscope
