// cuda/comparison/comparison_points.h: kernel bodies that compare each point of the model with a
// frame.
#pragma once

#include "cuda/comparison/comparison_layout.h"
#include "cuda/device/block_totals.h"
#include "cuda/device/kernel.h"
#include "fusion/anchor_agreement.h"
#include "fusion/fusion_weights.h"
#include "fusion/innovation.h"

namespace softscope::cuda {

/// One thread per point: compares it with the measurement; draws it as an occluder.
struct SightKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  ComparisonFrameLayout frame;
  ComparisonModelLayout model;
  PosedCamera camera;
  SightLimits limits;
  bool draws;  // also renders the model

  Grid blocks() const { return {blocksFor(model.count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= model.count) return;
    const Eigen::Vector3f left = camera.toLeft(model.positions_mm[i]);
    const PointSight sight = sightOf(left, camera.left_from_world * model.normals[i], camera,
                                     {frame.depth_mm, frame.normals, frame.states}, limits);
    model.sights[i] = sight;
    if (sight.pixel < 0) return;
    const std::uint32_t depth = floatAsBits(left.z());  // bits of positive floats have their order
    const int cell = frame.cellOf(sight.pixel);
    // An obsolete point occludes nothing.
    if (sight.sight != Sight::kSeenThrough) atomicLeast(&frame.near_cells[cell], depth);
    if (!draws) return;
    atomicLeast(&frame.drawn_cells[cell], depth);
    atomicLeast(&frame.drawn[sight.pixel],
                static_cast<unsigned long long>(DrawnPoints::entry(depth, i)));
  }
};

/// After SightKernel, one thread per point: occlusion by the model itself.
struct HideKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  ComparisonFrameLayout frame;
  ComparisonModelLayout model;
  PosedCamera camera;

  Grid blocks() const { return {blocksFor(model.count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= model.count) return;
    Sight sight = model.sights[i].sight;
    if ((sight == Sight::kSeen || sight == Sight::kTurned) && isHidden(i)) sight = Sight::kHidden;
    model.sights[i].sight = sight;
    model.seen[i] = sight == Sight::kSeen ? 1 : 0;
  }

 private:
  SOFTSCOPE_HD bool isHidden(int i) const {
    const Eigen::Vector3f left = camera.toLeft(model.positions_mm[i]);
    const float cosine = cosineToRay(left, camera.left_from_world * model.normals[i]);
    const float nearest_mm = bitsAsFloat(frame.near_cells[frame.cellOf(model.sights[i].pixel)]);
    return liesBehind(nearest_mm, ComparisonFrameLayout::kCellPx, left.z(), cosine, camera.fx_px,
                      static_cast<float>(VisibilityOptions::kOcclusionMm));
  }
};

/// Gray levels of the 3 x 3 places around a pixel, to the sums of its block; nothing where one of
/// them is outside. `add(word, value)` adds to a word of BlockSums.
template <class Add>
SOFTSCOPE_HD inline void addToBlock(const ComparisonFrameLayout& frame, std::uint32_t brightness,
                                    int u, int v, int shift_px, BlockSums* sums, const Add& add) {
  if (u < shift_px || v < shift_px || u + shift_px >= frame.width || v + shift_px >= frame.height)
    return;
  add(&sums->points, 1u);
  add(&sums->model, brightness);
  add(&sums->model_sq, brightness * brightness);
  for (int place = 0; place < BlockSums::kPlaces; ++place) {
    const int x = u + shift_px * BlockCorrelation::column(place);
    const int y = v + shift_px * BlockCorrelation::row(place);
    const std::uint32_t seen = toGray(frame.colour[y * frame.width + x]);
    add(&sums->places[place].image, seen);
    add(&sums->places[place].image_sq, seen * seen);
    add(&sums->places[place].product, brightness * seen);
  }
}

/// Inputs of the visible points.
struct SeenQuestions {
  bool gain = false, anchors = false, innovation = false;
  ColourOptions colour;
  int gain_stride = 1;
  float reference_mm = 0, largest_weight = 0;
};

/// After HideKernel, one thread per point: gain, anchors and innovation of visible points.
struct SeenKernel {
  using Totals = BlockTotals<256, 3>;
  static constexpr int kThreads = 256, kPhases = Totals::kSteps;
  using Shared = Totals::Shared;
  using Local = Nothing;
  ComparisonFrameLayout frame;
  ComparisonModelLayout model;
  ComparisonGraphLayout graph;
  SeenQuestions asked;

  Grid blocks() const { return {blocksFor(model.count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if constexpr (kPhase == 0) {
      FixedSum own[3] = {};
      if (i < model.count && model.seen[i] != 0) look(i, own);
      Totals::take(at.thread, own, shared);
    } else if constexpr (kPhase == 1) {
      Totals::addLane(at.thread, shared);
    } else if (at.thread < 3) {
      InnovationSums& frame_sums = frame.totals->frame;
      FixedSum* totals[] = {&frame_sums.weight, &frame_sums.away_mm, &frame_sums.expected_mm2};
      Totals::addTo(totals[at.thread], at.thread, shared);
    }
  }

 private:
  SOFTSCOPE_HD void look(int i, FixedSum (&own)[3]) const {
    const int pixel = model.sights[i].pixel;
    if (asked.gain && i % asked.gain_stride == 0) countGain(i, pixel);
    if (asked.anchors)
      addToBlock(frame, model.anchors[i], pixel % frame.width, pixel / frame.width,
                 AnchorAgreement::kSlipPx, &frame.anchors[frame.blockOf(pixel)],
                 [](std::uint32_t* word, std::uint32_t value) { atomicPlus(word, value); });
    if (asked.innovation) addDifference(i, pixel, own);
  }
  SOFTSCOPE_HD void countGain(int i, int pixel) const {
    const Rgb8 seen = frame.colour[pixel], known = model.colours[i];
    if (!isUsableForGain(seen, asked.colour) || !isUsableForGain(known, asked.colour)) return;
    count(0, seen.red, known.red);
    count(1, seen.green, known.green);
    count(2, seen.blue, known.blue);
  }
  SOFTSCOPE_HD void count(int channel, std::uint8_t seen, std::uint8_t known) const {
    const int bin = frame.gain_bins[seen * 256 + known];
    if (bin >= 0) atomicPlus(&frame.totals->gain[channel][bin], 1);
  }
  SOFTSCOPE_HD void addDifference(int i, int pixel, FixedSum (&own)[3]) const {
    const PointBinding& binding = model.bindings[i];
    if (!isCarried(binding, graph.stencil_count)) return;
    const double sigma_mm = frame.sigma_mm[pixel];
    const double weight =
        depthWeight(frame.sigma_mm[pixel], asked.reference_mm, asked.largest_weight);
    const double away_mm = std::abs(model.sights[i].ahead_mm);
    const double expected_mm2 = sigma_mm * sigma_mm;
    own[0] = toFixed(weight);
    own[1] = toFixed(weight * away_mm);
    own[2] = toFixed(weight * expected_mm2);
    const NodeStencil& stencil = graph.stencils[binding.stencil];
    for (int k = 0; k < kNodesPerPoint; ++k)
      add(&graph.sums[stencil[k]], weight * binding.weights[k], away_mm, expected_mm2);
  }
  SOFTSCOPE_HD static void add(InnovationSums* to, double weight, double away_mm,
                               double expected_mm2) {
    atomicPlus(&to->weight, toFixed(weight));
    atomicPlus(&to->away_mm, toFixed(weight * away_mm));
    atomicPlus(&to->expected_mm2, toFixed(weight * expected_mm2));
  }
};

/// One thread per node: mean absolute difference around it.
struct MeanDifferenceKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  ComparisonGraphLayout graph;
  const ComparisonTotals* totals;

  Grid blocks() const { return {blocksFor(graph.nodes, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int n = at.x * kThreads + at.thread;
    if (n >= graph.nodes) return;
    graph.away_mm[n] =
        innovationMean(fromFixed(graph.sums[n].away_mm), fromFixed(graph.sums[n].weight),
                       fromFixed(totals->frame.away_mm), fromFixed(totals->frame.weight));
  }
};

/// After MeanDifferenceKernel, one thread per point: squares of the counted differences.
struct SquareDifferenceKernel {
  using Totals = BlockTotals<256, 1>;
  static constexpr int kThreads = 256, kPhases = Totals::kSteps;
  using Shared = Totals::Shared;
  using Local = Nothing;
  ComparisonFrameLayout frame;
  ComparisonModelLayout model;
  ComparisonGraphLayout graph;
  float reference_mm, largest_weight;

  Grid blocks() const { return {blocksFor(model.count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if constexpr (kPhase == 0) {
      FixedSum own[1] = {};
      if (i < model.count && model.seen[i] != 0) look(i, own[0]);
      Totals::take(at.thread, own, shared);
    } else if constexpr (kPhase == 1) {
      Totals::addLane(at.thread, shared);
    } else if (at.thread == 0) {
      Totals::addTo(&frame.totals->frame.square_mm2, 0, shared);
    }
  }

 private:
  SOFTSCOPE_HD void look(int i, FixedSum& own) const {
    const PointBinding& binding = model.bindings[i];
    if (!isCarried(binding, graph.stencil_count)) return;
    const NodeStencil& stencil = graph.stencils[binding.stencil];
    double around_mm = 0;
    for (int k = 0; k < kNodesPerPoint; ++k)
      around_mm += static_cast<double>(binding.weights[k]) * graph.away_mm[stencil[k]];
    const double counted_mm = countedDifference(std::abs(model.sights[i].ahead_mm), around_mm);
    const double weight =
        depthWeight(frame.sigma_mm[model.sights[i].pixel], reference_mm, largest_weight);
    const double square_mm2 = counted_mm * counted_mm;
    own = toFixed(weight * square_mm2);
    for (int k = 0; k < kNodesPerPoint; ++k)
      atomicPlus(&graph.sums[stencil[k]].square_mm2,
                 toFixed(weight * binding.weights[k] * square_mm2));
  }
};

}  // namespace softscope::cuda
