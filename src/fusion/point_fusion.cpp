#include "fusion/point_fusion.h"

#include <atomic>

#include "core/parallel.h"
#include "fusion/fusing_formulas.h"

namespace softscope {
namespace {

/// Averaging of single points for one frame.
class Fuser {
 public:
  Fuser(const WarpGraph& graph, const FusingFrame& frame, const InnovationField& innovation,
        const AnchorAgreement& anchored, PointModel* model)
      : graph_(graph),
        frame_(frame),
        innovation_(innovation),
        anchored_(anchored),
        model_(*model) {}

  bool contradicts(std::size_t i, const PointSight& point) const {
    return isContradicted(point, model_.weights[i], frame_.limits);
  }

  void lose(std::size_t i, const PointSight& point) const {
    const Innovation around = innovation_.at(graph_, model_.bindings[i]);
    model_.weights[i] =
        weightAfterContradiction(model_.weights[i], around.excess_mm2, point.pixel, frame_);
  }

  /// False if the measurement has no weight.
  bool fuse(std::size_t i, const PointSight& sight) const {
    ModelPoint point{model_.positions_mm[i], model_.normals[i], model_.colours[i],
                     model_.anchors[i], model_.weights[i]};
    const bool fused = fusePoint(sight, surroundingsOf(i, sight.pixel), frame_, &point);
    model_.weights[i] = point.weight;
    if (!fused) return false;
    model_.positions_mm[i] = point.position_mm;
    model_.normals[i] = point.normal;
    model_.colours[i] = point.colour;
    model_.anchors[i] = point.anchor;
    return true;
  }

 private:
  FusingSurroundings surroundingsOf(std::size_t i, std::int32_t pixel) const {
    const PointBinding& binding = model_.bindings[i];
    FusingSurroundings around;
    around.innovation = innovation_.at(graph_, binding);
    around.anchored = anchored_.at(pixel);
    if (frame_.limits.node_trust != NodeTrust::kEqual &&
        isCarried(binding, static_cast<std::int32_t>(graph_.stencils.size())))
      around.node_mm = nearestNodeMm(graph_.stencils[static_cast<std::size_t>(binding.stencil)],
                                     graph_.positions_mm.data(), model_.positions_mm[i]);
    return around;
  }

  const WarpGraph& graph_;
  const FusingFrame frame_;
  const InnovationField& innovation_;
  const AnchorAgreement& anchored_;
  PointModel& model_;
};

/// Requires `visibility`.
void compareSeen(const PointModel& model, const WarpGraph& graph, const Observation& observation,
                 const PointFusionOptions& options, const ColourOptions& colour_options,
                 ModelComparison* comparison) {
  const Visibility& visibility = comparison->visibility;
  const auto findGainAndAnchors = [&] {
    comparison->gain = estimateGain(model, observation, visibility, colour_options);
    if (colour_options.hold_anchors)
      comparison->anchored = AnchorAgreement(model, observation, visibility);
  };
  // Independent.
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
  const FusingFrame frame = fusingFrame(observation, summary.gain, options, colour_options);
  const Fuser fuser(graph, frame, comparison.innovation, comparison.anchored, model);
  std::atomic<int> fused{0}, contradicted{0};
  parallelRanges(static_cast<int>(model->size()), kPointsPerTask, [&](int begin, int end) {
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
