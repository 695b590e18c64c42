// src/features/window_kernels.h: the inner loops of sub-pixel refinement, compiled once for each
// instruction set under the rules of kernels.h.
#pragma once

namespace softscope {

/// Row of the window that is refined: see subpixel_match.cpp.
constexpr int kWindowLanes = 16;
constexpr int kLargestWindow = 15;  // rows

/// What stays fixed while a window looks for its place. Arrays of rows x kWindowLanes, 0 where the
/// window has no weight.
struct WindowTemplate {
  const float* steepest_u;  // weighted, free of the window's mean and contrast
  const float* steepest_v;
  const float* contrast;  // weighted brightness minus its mean
  const float* weight;
  int rows;
};

/// Windows of one image that become templates at the same time, a window a lane.
constexpr int kTemplateLanes = 8;
struct TemplateWindows {
  const float* corner[kTemplateLanes];  // the pixel at (0, 0) of the window; one more on every side
                                        // is read
  const float* weight[kTemplateLanes];  // rows x kWindowLanes, sum 1
  int stride;
  int rows;  // and columns
};
/// Where WindowTemplate's arrays go, and what else a window tells: the variance of its brightness,
/// and the weighted products of its projected gradients. Not finite where the variance is 0.
struct TemplateResults {
  float* steepest_u[kTemplateLanes];
  float* steepest_v[kTemplateLanes];
  float* contrast[kTemplateLanes];
  float contrast_sq[kTemplateLanes];
  float uu[kTemplateLanes], uv[kTemplateLanes], vu[kTemplateLanes], vv[kTemplateLanes];
};

/// Weighted sums over the window of the live image at a sub-pixel place.
struct WindowSums {
  float along_u, along_v, along_contrast, mean, square;
};

struct WindowKernels {
  /// Gradients and contrast of windows, mean and contrast projected out of the gradients. Sums run
  /// by rows, each from left to right.
  void (*windowTemplates)(const TemplateWindows& windows, TemplateResults* out);
  /// Bilinear samples of the live image, with (0, 0) of the window at `corner` plus the fraction;
  /// rows + 1 rows of kWindowLanes + 1 values are read.
  WindowSums (*windowSums)(const WindowTemplate& fixed, const float* corner, int stride,
                           float fraction_u, float fraction_v);
};

}  // namespace softscope
