#include "fusion/point_fusion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "fusion/anchor_agreement.h"
#include "fusion/colour_levels.h"
#include "fusion/fusion_weights.h"
#include "fusion/innovation.h"

namespace softscope {
namespace {

/// Distance to the nearest node that carries the point, mm; negative where none does.
float nearestNodeMm(const WarpGraph& graph, const PointBinding& binding,
                    const Eigen::Vector3f& point_mm) {
  if (!binding.bound() || binding.stencil >= static_cast<std::int32_t>(graph.stencils.size()))
    return -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::int32_t node : graph.stencils[binding.stencil])
    nearest = std::min(nearest, (graph.positions_mm[node] - point_mm.cast<double>()).squaredNorm());
  return static_cast<float>(std::sqrt(nearest));
}

/// One frame's work on single points.
class Fuser {
 public:
  Fuser(const WarpGraph& graph, const Observation& observation, const PointFusionOptions& options,
        const ColourOptions& colour_options, const ColourGain& gain,
        const InnovationField& innovation, const AnchorAgreement& anchored, PointModel* model)
      : graph_(graph),
        observation_(observation),
        options_(options),
        colour_options_(colour_options),
        gain_(gain),
        innovation_(innovation),
        anchored_(anchored),
        model_(*model),
        camera_(posedCamera(observation.left, observation.world_from_left)),
        truncation_mm_(static_cast<float>(options.truncation_mm)),
        reference_mm_(static_cast<float>(options.reference_sigma_mm)),
        confirmed_weight_(static_cast<float>(options.kConfirmedWeight)),
        unseen_mm_(static_cast<float>(options.truncation_mm)),
        buried_mm_(static_cast<float>(options.buried_mm)) {
    const double reference = options.reference_sigma_mm > 0 ? options.reference_sigma_mm : 0.1;
    const double ratio = options.warp_sigma_mm / reference;
    warp_noise_ = static_cast<float>(ratio * ratio);
  }

  bool contradicts(std::size_t i, const PointSight& point) const {
    if (point.sight == Sight::kSeenThrough) return true;
    if (point.sight == Sight::kHidden && point.ahead_mm < -unseen_mm_ &&
        point.ahead_mm > -buried_mm_)
      return true;
    if (model_.weights[i] >= confirmed_weight_) return false;
    return point.sight == Sight::kHidden || point.sight == Sight::kTurned;
  }

  /// docs/fusion.md (F10).
  void lose(std::size_t i, const PointSight& point) const {
    const Innovation around = innovation_.at(graph_, model_.bindings[i]);
    model_.weights[i] = contradictedWeight(
        weightAfterInnovation(model_.weights[i], around.excess_mm2, reference_mm_),
        std::min(1.0f, depthWeightAt(point.pixel)),
        static_cast<float>(options_.kContradictionLoss));
  }

  /// docs/fusion.md (F8), (F9), (F13); false where the measurement has no weight.
  bool fuse(std::size_t i, const PointSight& point) const {
    const Innovation around = innovation_.at(graph_, model_.bindings[i]);
    const float truncation_mm = widenedTruncation(truncation_mm_, around.difference_mm2);
    if (!(std::abs(point.ahead_mm) < truncation_mm)) return false;
    float& weight = model_.weights[i];
    float measured = depthWeightAt(point.pixel) *
                     truncationWeight(point.ahead_mm, truncation_mm, options_.soft_truncation);
    const float node_mm = options_.node_trust == NodeTrust::kEqual
                              ? -1
                              : nearestNodeMm(graph_, model_.bindings[i], model_.positions_mm[i]);
    if (node_mm >= 0) {
      const float half_spacings = node_mm / (0.5f * static_cast<float>(options_.node_spacing_mm));
      measured *= nodeWeight(options_.node_trust, half_spacings);
      if (options_.node_trust == NodeTrust::kWarpNoise)
        weight = weightAfterWarp(weight, half_spacings, warp_noise_);
    }
    weight = weightAfterInnovation(weight, around.excess_mm2, reference_mm_);
    const float gain = averagingGain(weight, measured);
    if (!(gain > 0)) return false;
    const Eigen::Vector3f left = camera_.toLeft(model_.positions_mm[i]);
    updateColour(i, point.pixel, measured, left);  // before the weight grows
    moveTowards(i, point, left, gain);
    weight = grownWeight(weight, measured, static_cast<float>(options_.max_weight));
    return true;
  }

 private:
  float depthWeightAt(std::int32_t pixel) const {
    if (observation_.depth.sigma_mm.empty()) return 1;
    return depthWeight(observation_.depth.sigma_mm.values[static_cast<std::size_t>(pixel)],
                       reference_mm_, static_cast<float>(options_.max_measurement_weight));
  }

  void moveTowards(std::size_t i, const PointSight& point, const Eigen::Vector3f& left,
                   float gain) const {
    Eigen::Vector3f& position = model_.positions_mm[i];
    const std::size_t pixel = static_cast<std::size_t>(point.pixel);
    const Eigen::Vector3f step = left * (gain * point.ahead_mm / left.norm());
    position += camera_.left_from_world.transpose() * step;
    const Eigen::Vector3f measured =
        camera_.left_from_world.transpose() * observation_.normals.values[pixel];
    model_.normals[i] = ((1 - gain) * model_.normals[i] + gain * measured).normalized();
  }

  /// The image between its pixels. Places beyond the rim read the rim.
  Rgb8 colourAt(const Eigen::Vector3f& left) const {
    const ColourImage& picture = observation_.colour;
    const auto inside = [](float at, int count) {
      return std::clamp(at, 0.0f, static_cast<float>(count - 1));
    };
    const float column =
        inside(camera_.fx_px * left.x() / left.z() + camera_.cx_px, picture.width_px);
    const float row =
        inside(camera_.fy_px * left.y() / left.z() + camera_.cy_px, picture.height_px);
    const int u = static_cast<int>(column), v = static_cast<int>(row);
    const float right = column - static_cast<float>(u), low = row - static_cast<float>(v);
    const int next_u = std::min(u + 1, picture.width_px - 1);
    const int next_v = std::min(v + 1, picture.height_px - 1);
    const auto mix = [&](std::uint8_t Rgb8::*channel) {
      const float top =
          (1 - right) * picture.at(u, v).*channel + right * picture.at(next_u, v).*channel;
      const float bottom = (1 - right) * picture.at(u, next_v).*channel +
                           right * picture.at(next_u, next_v).*channel;
      return toByte((1 - low) * top + low * bottom);
    };
    return {mix(&Rgb8::red), mix(&Rgb8::green), mix(&Rgb8::blue)};
  }

  void updateColour(std::size_t i, std::int32_t pixel, float measured,
                    const Eigen::Vector3f& left) const {
    if (observation_.colour.empty()) return;
    const Rgb8 seen = observation_.colour.values[static_cast<std::size_t>(pixel)];
    if (isHighlight(seen, colour_options_)) return;
    const Rgb8 fresh = modelColour(colourAt(left), gain_);
    Rgb8& known = model_.colours[i];
    const int limit = colour_options_.brightening_limit;
    const bool brightened = fresh.red - known.red >= limit && fresh.green - known.green >= limit &&
                            fresh.blue - known.blue >= limit;
    if (brightened && model_.weights[i] >= confirmed_weight_) return;
    const float old = std::min(model_.weights[i], static_cast<float>(colour_options_.max_weight));
    const float gain = averagingGain(old, measured);
    known = {averaged(known.red, fresh.red, gain), averaged(known.green, fresh.green, gain),
             averaged(known.blue, fresh.blue, gain)};
    updateAnchor(i, pixel, toGray(fresh), measured, gain);
  }

  /// docs/fusion.md (F24).
  void updateAnchor(std::size_t i, std::int32_t pixel, std::uint8_t fresh, float measured,
                    float colour_gain) const {
    if (anchored_.at(pixel)) return;
    const float gain =
        colour_options_.hold_anchors
            ? averagingGain(static_cast<float>(colour_options_.kAnchorWeight), measured)
            : colour_gain;
    model_.anchors[i] = averaged(model_.anchors[i], fresh, gain);
  }

  static std::uint8_t averaged(std::uint8_t known, std::uint8_t fresh, float gain) {
    return toByte(static_cast<float>(known) +
                  gain * (static_cast<float>(fresh) - static_cast<float>(known)));
  }

  const WarpGraph& graph_;
  const Observation& observation_;
  const PointFusionOptions& options_;
  const ColourOptions& colour_options_;
  const ColourGain gain_;
  const InnovationField& innovation_;
  const AnchorAgreement& anchored_;
  PointModel& model_;
  const PosedCamera camera_;
  const float truncation_mm_, reference_mm_, confirmed_weight_, unseen_mm_, buried_mm_;
  float warp_noise_ = 0;
};

/// `visibility` is there already.
void compareSeen(const PointModel& model, const WarpGraph& graph, const Observation& observation,
                 const PointFusionOptions& options, const ColourOptions& colour_options,
                 ModelComparison* comparison) {
  const Visibility& visibility = comparison->visibility;
  const auto findGainAndAnchors = [&] {
    comparison->gain = estimateGain(model, observation, visibility, colour_options);
    if (colour_options.hold_anchors)
      comparison->anchored = AnchorAgreement(model, observation, visibility);
  };
  // Neither needs the other.
  parallelInvoke(findGainAndAnchors, [&] {
    if (options.follow_innovation)
      comparison->innovation = InnovationField(model, graph, observation, visibility, options);
  });
}

}  // namespace

ModelComparison compareModel(const PointModel& model, const WarpGraph& graph,
                             const Observation& observation, const Raster<PixelState>& states,
                             const FusionOptions& options) {
  options.validate();
  ModelComparison comparison;
  comparison.visibility = findVisible(model, observation, states, options.visibility);
  compareSeen(model, graph, observation, options.points, options.colour, &comparison);
  return comparison;
}

PointFusionSummary fusePoints(const WarpGraph& graph, const Observation& observation,
                              const Visibility& visibility, const PointFusionOptions& options,
                              const ColourOptions& colour_options, PointModel* model) {
  options.validate();
  colour_options.validate();
  observation.validate();
  requireVisibility(visibility, *model);
  ModelComparison comparison;
  comparison.visibility = visibility;
  compareSeen(*model, graph, observation, options, colour_options, &comparison);
  return fusePoints(graph, observation, comparison, options, colour_options, model);
}

PointFusionSummary fusePoints(const WarpGraph& graph, const Observation& observation,
                              const ModelComparison& comparison, const PointFusionOptions& options,
                              const ColourOptions& colour_options, PointModel* model) {
  options.validate();
  colour_options.validate();
  observation.validate();
  const Visibility& visibility = comparison.visibility;
  requireVisibility(visibility, *model);
  PointFusionSummary summary;
  summary.gain = comparison.gain;
  const Fuser fuser(graph, observation, options, colour_options, summary.gain,
                    comparison.innovation, comparison.anchored, model);
  std::atomic<int> fused{0}, contradicted{0};
  parallelRanges(static_cast<int>(model->size()), kPointsATask, [&](int begin, int end) {
    int fused_here = 0, contradicted_here = 0;
    for (int k = begin; k < end; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const PointSight& point = visibility.points[i];
      if (fuser.contradicts(i, point)) {
        fuser.lose(i, point);
        ++contradicted_here;
      } else if (point.sight == Sight::kSeen && fuser.fuse(i, point)) {
        ++fused_here;
      }
    }
    fused += fused_here;
    contradicted += contradicted_here;
  });
  summary.fused = fused;
  summary.contradicted = contradicted;
  return summary;
}

}  // namespace softscope
