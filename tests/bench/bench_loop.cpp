// tests/bench/bench_loop.cpp: what tissue out of view costs a frame.
//
// bench_loop CLIP [--backend auto|cpu|cuda] [--hidden POINTS] [--frames N]
// Reconstructs the clip to and fro, first as it is, then with copies of the model beside each other
// out of view, of at least POINTS points, nodes and edges included: a large organ, the same view.
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/sequences/frame_window.h"
#include "io/sequences/sequence_reader.h"
#include "pipeline/backends.h"
#include "pipeline/model/active_region.h"
#include "pipeline/reconstructor.h"
#include "tests/bench/bench_times.h"

using namespace softscope;
using namespace softscope::bench;

namespace {

constexpr int kWarmUp = 20;  // frames of the clip before the others are added, and after that

struct Clip {
  StereoCalibration calibration;
  std::vector<std::shared_ptr<const Frame>> frames;

  /// To and fro.
  const std::shared_ptr<const Frame>& at(int i) const {
    const int last = static_cast<int>(frames.size()) - 1, along = i % (2 * last);
    return frames[static_cast<std::size_t>(along < last ? along : 2 * last - along)];
  }

  UpcomingFrames upcomingAfter(int i) const {
    UpcomingFrames upcoming;
    for (int k = 1; k <= FrameWindow::kUpcoming; ++k) upcoming.push_back(at(i + k));
    return upcoming;
  }
};

Clip readClip(const std::string& folder) {
  SequenceReader reader(folder);
  Clip clip{reader.calibration(), {}};
  while (std::optional<FrameResult> result = reader.next())
    if (result->ok()) clip.frames.push_back(std::make_shared<const Frame>(result->frame));
  if (clip.frames.size() < 2) throw InputError(folder + ": fewer than two frames");
  return clip;
}

template <class Value>
void repeat(std::vector<Value>* values) {
  values->reserve(2 * values->size());
  values->insert(values->end(), values->begin(), values->end());
}

/// The second half of the values, which repeats the first.
template <class Value, class Change>
void changeSecondHalf(std::vector<Value>* values, const Change& change) {
  std::for_each(values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2), values->end(),
                change);
}

/// Hidden points between the nearest nodes of both halves, so that they are one organ.
void connectHalves(ModelState* state) {
  constexpr std::size_t kConnections = 20;
  struct Pair {
    double away_mm2;
    std::int32_t first, second;
  };
  WarpGraph& graph = state->graph;
  PointModel& model = state->model;
  const std::int32_t half = static_cast<std::int32_t>(graph.size() / 2);
  std::vector<Pair> pairs;
  for (std::int32_t second = half; second < 2 * half; ++second) {
    Pair nearest{std::numeric_limits<double>::infinity(), 0, second};
    for (std::int32_t first = 0; first < half; ++first) {
      const double away_mm2 = (graph.positions_mm[static_cast<std::size_t>(first)] -
                               graph.positions_mm[static_cast<std::size_t>(second)])
                                  .squaredNorm();
      if (away_mm2 < nearest.away_mm2) nearest = {away_mm2, first, second};
    }
    pairs.push_back(nearest);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& one, const Pair& other) { return one.away_mm2 < other.away_mm2; });
  pairs.resize(std::min(kConnections, pairs.size()));
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d middle_mm = (graph.positions_mm[static_cast<std::size_t>(pair.first)] +
                                       graph.positions_mm[static_cast<std::size_t>(pair.second)]) /
                                      2;
    model.add(middle_mm.cast<float>(), model.normals.front(), model.colours.front(),
              model.weights.front());
    model.bindings.back() = {static_cast<std::int32_t>(graph.stencils.size()), {0.5F, 0.5F}};
    graph.stencils.push_back({pair.first, pair.second, pair.second, pair.second});
    graph.edges.push_back({pair.first, pair.second});
  }
  std::sort(graph.edges.begin(), graph.edges.end(),
            [](const GraphEdge& one, const GraphEdge& other) {
              return std::pair(one.first, one.second) < std::pair(other.first, other.second);
            });
}

/// Model and graph once more, beside all that there is, and connected with it.
void repeatAside(const Eigen::Vector3f& aside_mm, ModelState* state) {
  PointModel& model = state->model;
  WarpGraph& graph = state->graph;
  const std::int32_t nodes = static_cast<std::int32_t>(graph.size()),
                     stencils = static_cast<std::int32_t>(graph.stencils.size());
  const Eigen::Vector3d nodes_aside_mm = aside_mm.cast<double>();
  repeat(&model.positions_mm);
  changeSecondHalf(&model.positions_mm, [&](Eigen::Vector3f& at_mm) { at_mm += aside_mm; });
  repeat(&model.normals);
  repeat(&model.colours);
  repeat(&model.anchors);
  repeat(&model.weights);
  repeat(&model.bindings);
  changeSecondHalf(&model.bindings, [&](PointBinding& binding) {
    if (binding.bound()) binding.stencil += stencils;
  });
  repeat(&graph.positions_mm);
  changeSecondHalf(&graph.positions_mm, [&](Eigen::Vector3d& at_mm) { at_mm += nodes_aside_mm; });
  repeat(&graph.transforms);
  repeat(&graph.since_reference);
  repeat(&graph.turned);
  repeat(&graph.edges);
  changeSecondHalf(&graph.edges, [&](GraphEdge& edge) {
    edge.first += nodes;
    edge.second += nodes;
  });
  repeat(&graph.stencils);
  changeSecondHalf(&graph.stencils, [&](NodeStencil& stencil) {
    for (std::int32_t& node : stencil) node += nodes;
  });
  repeat(&state->errors.nodes_mm2);
  repeat(&state->errors.nodes_mm);
  changeSecondHalf(&state->errors.nodes_mm,
                   [&](Eigen::Vector3d& at_mm) { at_mm += nodes_aside_mm; });
  connectHalves(state);
}

/// To the right, below, to the left, above, …: the view is in the middle in the end.
void addHidden(std::size_t points, ModelState* state) {
  constexpr float kGapMm = -8;  // outlines are no boxes
  const std::size_t least = state->model.size() + points;
  for (int k = 0; state->model.size() < least; ++k) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& point_mm : state->model.positions_mm) box.extend(point_mm);
    const int axis = k % 2;
    Eigen::Vector3f aside_mm = Eigen::Vector3f::Zero();
    aside_mm[axis] = (box.sizes()[axis] + kGapMm) * (k % 4 < 2 ? 1.0F : -1.0F);
    repeatAside(aside_mm, state);
  }
  state->graph.edge_shapes.clear();  // of edges in another order
}

/// Prints the times of the frames behind the first ones; returns the median of a frame.
double time(const Clip& clip, const std::string& backend, std::size_t hidden, int frames) {
  const ReconstructionOptions options;
  Reconstructor reconstructor{makeBackend(backend, clip.calibration, options).part, options};
  std::vector<double> whole_ms;
  std::map<std::string, std::vector<double>> laps;
  std::vector<std::string> order;
  for (int i = 0; i < frames + 2 * kWarmUp; ++i) {
    if (i == kWarmUp && hidden > 0) {
      const ReconstructionStateView now = reconstructor.state();
      ReconstructionState state{now.model, now.scope, now.others, now.maps};
      addHidden(hidden, &state.model);
      reconstructor.restore(std::move(state));
    }
    const double start_ms = nowMs();
    const FrameRecord record = reconstructor.process(*clip.at(i), clip.upcomingAfter(i));
    if (i < 2 * kWarmUp) continue;
    whole_ms.push_back(nowMs() - start_ms);
    for (const auto& [name, elapsed_ms] : record.times) {
      if (laps.find(name) == laps.end()) order.push_back(name);
      laps[name].push_back(elapsed_ms);
    }
    if (!record.fused()) std::printf("  frame %d: %s\n", i, record.reason.c_str());
  }
  const ModelState& state = reconstructor.model();
  const auto afar = std::count(state.graph.afar.begin(), state.graph.afar.end(), 1);
  const ReconstructionBackend& on = reconstructor.backend();
  const std::size_t inactive = countInactive(state);
  std::printf("%s, %s: %zu points (%zu inactive), %zu nodes, %td of them far from what is seen\n",
              on.name().c_str(), on.device().c_str(), state.model.size() + inactive, inactive,
              state.graph.size(), afar);
  print("frame", whole_ms);
  for (const std::string& name : order) print(name.c_str(), laps[name]);
  return atShare(whole_ms, 0.5);
}

int usage() {
  std::fprintf(stderr,
               "usage: bench_loop CLIP [--backend auto|cpu|cuda] [--hidden POINTS] [--frames N]\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string clip, backend = "auto";
  int hidden = 2000000, frames = 100;
  for (int i = 1; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (std::strcmp(argv[i], "--backend") == 0 && has_value)
      backend = argv[++i];
    else if (std::strcmp(argv[i], "--hidden") == 0 && has_value)
      hidden = std::atoi(argv[++i]);
    else if (std::strcmp(argv[i], "--frames") == 0 && has_value)
      frames = std::atoi(argv[++i]);
    else if (clip.empty() && argv[i][0] != '-')
      clip = argv[i];
    else
      return usage();
  }
  if (clip.empty() || hidden < 1 || frames < 1) return usage();
  return orErrorCode([&] {
    const Clip frames_of = readClip(clip);
    const double small_ms = time(frames_of, backend, 0, frames);
    const double large_ms = time(frames_of, backend, static_cast<std::size_t>(hidden), frames);
    std::printf("with the hidden points, %.2f times the frame\n", large_ms / small_ms);
    return 0;
  });
}
