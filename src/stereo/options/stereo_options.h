// src/stereo/options/stereo_options.h: options of stereo matching and their defaults.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace softscope {

/// Fields are settings (stereo_settings.h) or differ between
/// uses of a matcher; all others are constants of the method.

/// ELAS (Geiger, Roser, Urtasun, ACCV 2010), stage by stage. Costs are mean absolute differences
/// of the gradient descriptors, so that thresholds are independent of the window size.
struct ElasOptions {
  // Gradients: Sobel responses become 8-bit descriptors, 128 = flat.
  // 8-bit steps per Sobel unit; larger: more sensitive to weak texture
  static constexpr double gradient_gain = 0.5;

  // Support points: pixels that are matched without a prior.
  int support_step_px = 5;                           // grid of candidates
  static constexpr double support_texture = 1.0;     // minimum mean |gradient| of the window
  static constexpr double support_uniqueness = 0.8;  // maximum best cost over second best
  static constexpr int support_left_right_px = 1;    // maximum distance of the reverse match
  static constexpr int support_window_cells = 5;  // neighbours, in grid steps, that must agree …
  static constexpr int support_agreement_px = 5;  // … to this many pixels …
  static constexpr int support_min_neighbours = 5;  // … and at least so many of them

  static constexpr double prior_sigma_px = 1.0;  // of the distance of the surface from its prior
  // cost of a distant surface, in mean gradient steps
  static constexpr double prior_weight = 1.0;

  // Post-processing.
  static constexpr int left_right_px = 1;         // left and right disparity agree to this
  int speckle_size_px = 150;                      // smaller islands are removed
  static constexpr double speckle_step_px = 1.0;  // neighbours of one island differ at most by this
  static constexpr int gap_width_px = 6;  // gaps in a row or column up to this are interpolated …
  static constexpr double gap_step_px = 2.0;  // … if both sides differ at most by this

  // Where texture is too weak at full size, half size may be sufficient, or a quarter.
  int coarser_levels = 2;
  // minimum share of unmatched pixels for that
  static constexpr double coarser_above = 0.05;
};

/// Sub-pixel refinement: a plane fitted to the brightness in a window about each pixel.
struct RefinementOptions {
  // Steps: first the plane of the disparity, then that of the remaining difference, which returns
  // relief that the planes have levelled out.
  static constexpr int plane_steps = 3, relief_steps = 2, steps = plane_steps + relief_steps;
  static constexpr int radius_px = 6;  // window is (2 r + 1)²
  // Brightness is split at this scale. The high-pass part always counts; the low-pass
  // part, which light and exposure change, where both cameras agree (docs/stereo.md, 4).
  static constexpr double highpass_sigma_px = 2;
  // difference of the low-pass parts, in grey levels, that quarters their weight
  static constexpr double light_gray = 2.0;
  // share of the low-pass information that counts in the standard error
  static constexpr double slow_evidence = 0.5;
  // residual, in grey levels, that halves a pixel's weight
  static constexpr double noise_gray = 2.0;
  static constexpr double noise_floor_gray = 0.4;  // noise of a perfect match
  static constexpr double model_sigma_px = 0.05;   // error independent of texture
  // weight of the matched disparity where texture is weak
  static constexpr double prior_sigma_px = 1.0;
  static constexpr double relaxation[plane_steps] = {2, 1.5, 1};  // share of a step applied
  // (R - L)² as a share of R² + L²; unrelated images have 1
  static constexpr double max_difference = 0.5;
  // pixels whose predicted standard error is larger are dropped
  static constexpr double max_sigma_px = 2.0;
  int halvings = 0;  // of the images

  /// As the noise of the mean of four pixels.
  double lightGray() const { return std::ldexp(light_gray, -halvings); }
  /// Whether pixels are dropped beyond the evidence of their windows, at the rim of what is
  /// measured; and those of uneven windows. At smaller sizes windows are wider on the tissue.
  bool dropsBeyondEvidence() const { return halvings >= 1; }
  bool dropsUneven() const { return halvings >= 2; }
  /// Standard deviation of the Gaussian window, and the area of correlated errors.
  double windowSigmaPx() const { return 0.55 * radius_px; }
  double independentPx2() const { return 4 * M_PI * windowSigmaPx() * windowSigmaPx(); }
  /// Noise of returned relief over the variance of the planes' noise: its variance, and its
  /// covariance with theirs. Integrals of (P - P²)² and P (P - P²) over that of P², P the Gaussian
  /// response of a window.
  static constexpr double kReliefNoise = 1.0 / 6, kReliefCovariance = 1.0 / 3;
  /// Relief that is alike over many windows is divided by the share of it that the steps return, by
  /// this at least.
  static constexpr double kLeastResponse = 0.5;
  /// The same where all relief is returned: errors vary by so much more and are alike over so much
  /// less area.
  static constexpr double kNoiseWithRelief = 1 + 2 * kReliefCovariance + kReliefNoise;

  static constexpr int kLargestRadiusPx = 7;  // 16 lanes hold a window's row
};

/// Smoothing: every pixel moves towards the quadric patch of its neighbours.
struct SmoothingOptions {
  int block_px = 0;      // squares whose means represent their pixels; 0: an 80th of the width
  int reach_blocks = 2;  // of a window, to each side; 0: no smoothing
  static constexpr double relief_px = 0.1;  // of tissue, not represented by a patch

  static constexpr int kSmallestBlockPx = 4;
  /// In images of this width.
  int blockPx(int width_px) const {
    return block_px > 0 ? block_px : std::max(kSmallestBlockPx, (width_px + 40) / 80);
  }
};

/// The network of the user (docs/stereo.md, 8).
struct NetworkOptions {
  static constexpr int agreement_radius_px = 6;  // window of the agreement is (2 r + 1)²
  static constexpr double model_sigma_px = 0.1;  // error that agreement does not show
  static constexpr double left_right_px = 1.0;   // left and right disparity agree to this
};

/// Names of the matchers, from the list of makeStereoMatcher().
std::vector<std::string> stereoMethods();

/// Options common to all matchers.
struct StereoOptions {
  std::string method = "elas";         // one of stereoMethods()
  std::string model;                   // of "onnx": the network's file
  std::string model_input = "levels";  // input range for the levels 0 to 255
  int disparity_min_px = 0;
  int disparity_max_px = 0;                // 0: 255 or two fifths of the width
  static constexpr int darkest_gray = 10;  // darker pixels cannot be matched …
  int dark_margin_px = 4;                  // … nor those this close to them
  // measured pixels this close to a depth step are removed …
  static constexpr int erode_edges_px = 1;
  static constexpr double edge_step_px = 2.0;  // … where neighbours differ by more than this
  static constexpr int border_px = 2;          // pixels this close to the border are removed
  ElasOptions elas;
  RefinementOptions refinement;
  SmoothingOptions smoothing;
  static constexpr int sgbm_block_px = 5;

  static constexpr int kLargestDisparityPx = 1023;

  /// With the largest disparity in images of this width: nearer tissue is in three fifths of both
  /// images at most. Small images keep the range of larger ones, which costs little and denies more
  /// wrong matches.
  StereoOptions forWidth(int width_px) const {
    StereoOptions options = *this;
    if (disparity_max_px == 0)
      options.disparity_max_px = std::clamp(2 * width_px / 5 - 1, 255, kLargestDisparityPx);
    return options;
  }

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

}  // namespace softscope
