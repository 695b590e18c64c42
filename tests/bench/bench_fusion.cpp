// tests/bench/bench_fusion.cpp: time of stage 7, step by step, as a table for docs/benchmarks.md.
//   build/release/tests/bench/bench_fusion
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

#include "core/parallel.h"
#include "fusion/back_projection_error.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

/// The fastest of several runs, so that other programs disturb least; prepare() is not timed.
double fastestMs(const std::function<void()>& prepare, const std::function<void()>& work) {
  std::vector<double> times_ms;
  for (int k = 0; k < 15; ++k) {
    prepare();
    const auto start = std::chrono::steady_clock::now();
    work();
    times_ms.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count());
  }
  return *std::min_element(times_ms.begin(), times_ms.end());
}

/// About `points` points over a ball, most of them in the picture, each bound to a node.
PointModel makeModel(int points, const PinholeCamera& left) {
  const double extent_mm = std::sqrt(points * 0.04 * 0.88);
  PinholeCamera wide = left;  // fine enough for the 0.2 mm grid to decide the density
  wide.width_px = static_cast<int>(1.0 * extent_mm / 0.1);
  wide.height_px = wide.width_px;
  wide.fx_px = wide.fy_px = 550;
  wide.cx_px = wide.cy_px = (wide.width_px - 1) / 2.0;
  PointModel model;
  InsertionMemory memory;
  const Shot shot = takeShot(sphere({0, 0, 205}, 150), wide);
  update(shot, {}, &memory, &model);
  for (PointBinding& binding : model.bindings) binding = {0, {1, 0, 0, 0}};
  return model;
}

void measure(int width_px, int height_px, int points) {
  const double focal_px = 560.0 * width_px / 640;
  const PinholeCamera left = smallCamera(width_px, height_px, focal_px);
  Shot shot = takeShot(sphere({0, 0, 205}, 150), left, Eigen::Isometry3d::Identity(), 2e-5);
  addNoise(1, &shot);
  const PointModel model = makeModel(points, left);
  const Observation observation = shot.observation();
  WarpGraph graph;
  graph.positions_mm.assign(1, Eigen::Vector3d(0, 0, 55));
  graph.stencils = {{0, 0, 0, 0}};
  const FusionOptions options;
  const auto nothing = [] {};
  Raster<PixelState> states;
  Visibility visibility;
  PointModel work;
  InsertionMemory memory;
  const double judge =
      fastestMs(nothing, [&] { states = classifyPixels(observation, options.pixels); });
  const double see = fastestMs(
      nothing, [&] { visibility = findVisible(model, observation, states, options.visibility); });
  const double fuse = fastestMs(
      [&] { work = model; },
      [&] { fusePoints(graph, observation, visibility, options.points, options.colour, &work); });
  const double insert = fastestMs(
      [&] { work = model; },
      [&] { insertPoints(observation, states, visibility, {}, options, &memory, &work); });
  work = model;
  fusePoints(graph, observation, visibility, options.points, options.colour, &work);
  const PointModel fused = work;
  const double density =
      fastestMs([&] { work = fused; }, [&] { keepDensity(options.density, {}, &work); });
  const double error = fastestMs(nothing, [&] { backProjectionError(model, observation, states); });
  const auto seen = visibility.seen().size();
  std::printf("| %dx%d | %zu | %zu | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f |\n", width_px,
              height_px, model.size(), seen, judge, see, fuse, insert, density,
              judge + see + fuse + insert + density, error);
}

}  // namespace
}  // namespace softscope::test

int main() {
  using softscope::test::measure;
  std::printf("Milliseconds, fastest of 15, %d threads\n", softscope::threadCount());
  std::printf(
      "| picture | points | seen | judge pixels | see | average | insert | density | together | "
      "back-projection error |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int points : {60000, 200000}) {
    measure(360, 288, points);
    measure(640, 480, points);
  }
}
