// tests/features/sequence_truth.h: where tissue of a rendered sequence went, from frame to frame.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "core/point_model.h"
#include "core/stereo_rig.h"
#include "features/highlight_mask.h"
#include "features/matcher.h"
#include "features/model_view.h"
#include "io/calibrations/calibration_reader.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/trajectory_file.h"
#include "io/images/image_reader.h"

namespace softscope::test {

inline std::string frameName(int frame) {
  std::ostringstream name;
  name << std::setw(6) << std::setfill('0') << frame;
  return name.str();
}

/// The left image, in any form.
inline ColourImage readLeft(const std::filesystem::path& folder, int frame) {
  const std::filesystem::path jpg = folder / "left" / (frameName(frame) + ".jpg");
  return readColourImage(
      std::filesystem::exists(jpg) ? jpg : folder / "left" / (frameName(frame) + ".png"));
}

/// The live side: grey, without highlights and what `mask` (may be empty) names.
inline MatchPicture pictureOf(const ColourImage& colour, const Mask& mask = {}) {
  MatchPicture picture{toGray(colour), highlightMask(colour)};
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask.values[i] != 0) picture.ignore.values[i] = 1;
  return picture;
}

/// The model side: what shows no model is left out.
inline MatchPicture pictureOf(const ModelView& view) {
  MatchPicture picture = pictureOf(view.colour);
  for (std::size_t i = 0; i < view.depth_mm.size(); ++i)
    if (!(view.depth_mm.values[i] > 0)) picture.ignore.values[i] = 1;
  return picture;
}

/// A rendered sequence's tissue points, frame after frame.
struct SequenceTruth {
  PinholeCamera camera;
  Trajectory poses;
  std::vector<std::vector<Eigen::Vector3d>> tracks_mm;  // [frame][id], world

  explicit SequenceTruth(const std::filesystem::path& folder);

  int frames() const { return static_cast<int>(poses.size()); }

  Eigen::Vector2d pixel(int frame, std::size_t id) const {
    const std::size_t f = static_cast<std::size_t>(frame);
    return projectPoint<double>(camera, poses[f].world_from_left.inverse() * tracks_mm[f][id]);
  }
};

/// How far pixels moved between two frames: an affine fit to the tracks around, which are 20 px
/// apart. Left-out tracks are met to 0.013 px (heart) and 0.027 px (kidney) in the median.
class TrueFlow {
 public:
  TrueFlow(const SequenceTruth& truth, int from, int to) {
    for (std::size_t id = 0; id < truth.tracks_mm[0].size(); ++id) {
      from_.push_back(truth.pixel(from, id));
      shift_.push_back(truth.pixel(to, id) - from_.back());
    }
  }

  /// False where there are too few tracks, or they move too differently.
  bool at(const Eigen::Vector2d& place, Eigen::Vector2d* shift_px) const;

 private:
  std::vector<Eigen::Vector2d> from_, shift_;
};

/// Errors of many matches, as far as the truth is known.
struct FlowErrors {
  std::size_t matches = 0;
  std::vector<double> error_px, in_sigmas;

  void add(const std::vector<PixelMatch>& found, const TrueFlow& flow) {
    matches += found.size();
    for (const PixelMatch& match : found) {
      Eigen::Vector2d shift;
      if (!flow.at(match.model_px.cast<double>(), &shift)) continue;
      error_px.push_back((match.live_px - match.model_px).cast<double>().operator-(shift).norm());
      in_sigmas.push_back(error_px.back() / match.sigma_px);
    }
  }
  /// Value that this share of the errors does not exceed; NaN without errors.
  static double quantile(std::vector<double> values, double share) {
    if (values.empty()) return std::nan("");
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }
  double outlierShare() const {
    double count = 0;
    for (const double e : error_px) count += e > 1 ? 1 : 0;
    return error_px.empty() ? 0 : count / static_cast<double>(error_px.size());
  }
};

/// A point model of one frame's true depth: means over voxels of 0.2 mm.
PointModel modelOfFrame(const ColourImage& colour, const Raster<float>& depth_mm,
                        const PinholeCamera& camera, const Eigen::Isometry3d& world_from_left);

}  // namespace softscope::test
