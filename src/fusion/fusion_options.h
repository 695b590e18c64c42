// src/fusion/fusion_options.h: options of fusion and their defaults.
#pragma once

#include <limits>

namespace softscope {

/// Weight of a warped point by the distance to its nodes: docs/fusion.md (F7).
enum class NodeTrust {
  kEqual,      // uniform
  kWarpNoise,  // the warp adds noise far from nodes: old weight decreases, new weight is full
  kPaper,      // formula of the paper as printed: measurements near nodes have lower weights
};

/// Selection of pixels.
struct PixelOptions {
  static constexpr double kMaxDepthMm =
      500;                    // no endoscope sees further: such depths are no depths
  double max_sigma_mm = 1.0;  // depths with a larger sigma are ignored
  // share of the depth: larger differences are a depth edge …
  static constexpr double kEdgeStep = 0.02;
  static constexpr int kEdgeRadiusPx = 2;  // … and pixels this close to it are ignored
  // between normal and ray: more oblique surfaces are ignored
  static constexpr double kMinCosine = 0.2;

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Visibility of points: docs/fusion.md (F3), (F4).
struct VisibilityOptions {
  double max_distance_mm = 2.0;                 // epsilon_d, along the ray
  static constexpr double kMaxAngleDeg = 60.0;  // epsilon_n
  // a point this far behind the nearest surface of the model is hidden
  static constexpr double kOcclusionMm = 1.0;
  static constexpr int kOcclusionCellPx = 4;  // squares in which that surface is determined
};

/// Update of points by measurements: docs/fusion.md (F5) to (F10), (F21) to (F23).
struct PointFusionOptions {
  double truncation_mm = 1.0;           // tau: larger differences are not averaged
  bool soft_truncation = true;          // weights decrease smoothly to 0 at tau
  double max_weight = 10.0;             // omega_max
  double reference_sigma_mm = 0.1;      // depth of this sigma weighs 1, others by inverse variance;
                                        // 0: all depths weigh 1
  double max_measurement_weight = 2.0;  // maximum weight of a depth
  NodeTrust node_trust = NodeTrust::kWarpNoise;
  double node_spacing_mm = 4.0;   // epsilon of the paper
  double warp_sigma_mm = 0.02;    // error of one warp, half a node spacing away from all nodes
  bool follow_innovation = true;  // where frame and warped model differ by more than
                                  // the depth error, the model is that less certain
  // loss of a contradicted point per frame: this share of its weight,
  // and half this share of the weight of a measurement
  static constexpr double kContradictionLoss = 0.85;
  double buried_mm = 6.0;  // points up to this depth behind the measured surface lose
                           // weight too: the surface came nearer, and they are its past
  // below it, an unconfirmed visible point loses weight in the same way
  static constexpr double kConfirmedWeight = 3.0;

  void validate() const;
};

/// Update of colours: docs/fusion.md (F11), (F13).
struct ColourOptions {
  bool compensate_gain = true;  // of the frame against the model, a factor per channel
  double max_weight = 4.0;      // new colours count at least 1 / (1 + max_weight)
  // the appearance used for matching is kept while images agree with it; false: the colour
  bool hold_anchors = true;
  static constexpr double kAnchorWeight = 40.0;  // elsewhere new colours weigh about 1 / this
  int highlight_level = 225;                     // brighter in all channels = specular
  int brightening_limit = 50;                    // brighter than the point by this: also specular

  void validate() const;
};

/// Insertion of points: docs/fusion.md (F14) to (F16).
struct InsertionOptions {
  double spacing_mm = 0.2;  // between new points, and from them to old ones, …
  // … but no more than this in the image: near tissue and fine images get more points
  static constexpr double kMostSpacingPx = 2.4;
  double max_sigma_mm = 0.5;  // depths with a larger sigma add no points …
  // … nor do those with a larger sigma of the disparity: of sigma over the square of the depth
  double max_sigma_over_square_per_mm = std::numeric_limits<double>::infinity();
  double band_mm = 2.0;  // a model point this close in depth explains a pixel
  bool confirm = true;   // require two consecutive frames

  void validate() const;
};

/// Density of the model: docs/fusion.md (F17), (F18).
struct DensityOptions {
  double cell_mm = 0.2;  // halved until it is no wider than InsertionOptions::kMostSpacingPx
  // between normals of points that are merged: two sides stay separate
  static constexpr double kMaxAngleDeg = 60.0;
};

/// Options of stage 7.
struct FusionOptions {
  PixelOptions pixels;
  VisibilityOptions visibility;
  PointFusionOptions points;
  ColourOptions colour;
  InsertionOptions insertion;
  DensityOptions density;

  /// The options of the paper: the printed weights, equal weights of all depths,
  /// a hard truncation, the latest colour, no confirmation of new points.
  static FusionOptions paper();

  void validate() const;
};

}  // namespace softscope
