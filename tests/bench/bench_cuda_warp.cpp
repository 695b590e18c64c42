// tests/bench/bench_cuda_warp.cpp: the warp's solver on the GPU: the CPU's energy, and how long.
//
// bench_cuda_warp [--width MM] [--height MM] [--repeats N] [--check]
// A bent hill with a point every 0.2 mm and a node every 4 mm, 640 x 480 pixels, 7000 matches.
// --check compares alone, for compute-sanitizer.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "cuda/warp/warp.h"
#include "tests/bench/cuda_bench.h"
#include "tests/cuda/warp_cases.h"

using namespace softscope;
using namespace softscope::bench;

namespace {

/// Prints times of whole solves and of their parts; returns the last solution.
test::WarpScene::Found time(const char* name, const test::WarpScene& scene, DeformSolver& solver,
                            int repeats) {
  std::vector<double> whole_ms, prepare_ms, linearise_ms, step_ms;
  test::WarpScene::Found found;
  for (int i = 0; i < repeats; ++i) {
    const double start = nowMs();
    found = scene.solve(&solver);
    whole_ms.push_back(nowMs() - start);
    const DeformTimes& times = found.summary.times;
    prepare_ms.push_back(times.prepare_ms);
    linearise_ms.push_back(times.associate_ms + times.assemble_ms);
    step_ms.push_back(times.factor_ms + times.evaluate_ms);
  }
  const DeformSummary& of = found.summary;
  std::printf("%s: %d steps, %d rejected, energy %.9g, pivots 1 : %.3g\n", name, of.iterations,
              of.rejections, of.after.total(), 1 / of.pivot_ratio);
  print("  whole", whole_ms);
  print("  prepare", prepare_ms);
  print("  associate, assemble", linearise_ms);
  print("  factor, solve, evaluate", step_ms);
  return found;
}

int run(double width_mm, double height_mm, int repeats) {
  const double step_mm = 0.2;
  const int points = static_cast<int>(width_mm * height_mm / (step_mm * step_mm));
  test::WarpCase of{"bench", width_mm, height_mm, 4, true, std::max(points / 7000, 1)};
  of.step_mm = step_mm;
  of.visible_share = 1;
  const double f_px = 640 * 60 / (width_mm + 4);
  of.camera = {640, 480, f_px, f_px, 319.5, 239.5};
  const test::WarpScene scene(of);
  const auto cpu = makeDeformSolver(scene.options());
  const auto gpu = makeDeformSolver(
      scene.options(),
      makeDeviceWarpSystem(scene.options(), cuda::makeWarpDevice(scene.weights())));
  const auto expected = time("cpu", scene, *cpu, std::max(repeats / 4, 1));
  const auto found = time("cuda", scene, *gpu, repeats);
  const auto again = scene.solve(gpu.get());
  const double energy = found.summary.after.total() / expected.summary.after.total() - 1;
  std::printf("%zu nodes, %d points: energy differs by %.2g, transforms by %.2g; again: by %g\n",
              found.graph.size(), found.summary.points_after, energy,
              test::furthestApart(found.graph, expected.graph),
              test::furthestApart(found.graph, again.graph));
  return std::abs(energy) < 1e-6 && test::furthestApart(found.graph, again.graph) == 0 ? 0 : 1;
}

int usage() {
  std::fprintf(stderr,
               "usage: bench_cuda_warp [--width MM] [--height MM] [--repeats N] [--check]\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  double width_mm = 60, height_mm = 45;
  int repeats = 200;
  for (int i = 1; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (std::strcmp(argv[i], "--check") == 0)
      repeats = 1;
    else if (std::strcmp(argv[i], "--width") == 0 && has_value)
      width_mm = std::atof(argv[++i]);
    else if (std::strcmp(argv[i], "--height") == 0 && has_value)
      height_mm = std::atof(argv[++i]);
    else if (std::strcmp(argv[i], "--repeats") == 0 && has_value)
      repeats = std::atoi(argv[++i]);
    else
      return usage();
  }
  if (!(width_mm > 1 && height_mm > 1 && repeats > 0)) return usage();
  try {
    return run(width_mm, height_mm, repeats);
  } catch (const Error& error) {
    std::fprintf(stderr, "bench_cuda_warp: %s\n", error.what());
    return 1;
  }
}
