// tests/bench/bench_surface.cpp: time from points to a surface, for docs/benchmarks.md.
//   build/release/tests/bench/bench_surface
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>

#include "core/parallel.h"
#include "mesh/made_clouds.h"
#include "mesh/mesh_check.h"
#include "mesh/surface_from_points.h"

namespace softscope {
namespace {

struct Times {
  double wall_ms = 1e9, processor_ms = 1e9;  // of all threads together
};

/// The fastest of several runs, so that other programs disturb least.
Times fastest(const PointCloud& cloud) {
  Times times;
  for (int k = 0; k < 8; ++k) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t start_clock = std::clock();
    surfaceFromPoints(cloud);
    const double processor_ms = 1e3 * double(std::clock() - start_clock) / CLOCKS_PER_SEC;
    const auto end = std::chrono::steady_clock::now();
    times.wall_ms =
        std::min(times.wall_ms, std::chrono::duration<double, std::milli>(end - start).count());
    times.processor_ms = std::min(times.processor_ms, processor_ms);
  }
  return times;
}

void measure(double least_z_mm) {
  const PointCloud cloud = capPoints(60, least_z_mm, 0.2);
  const PointSurface surface = surfaceFromPoints(cloud);
  const MeshCheck check = checkMesh(surface.mesh);
  const Times every_core = fastest(cloud);
  const ThreadLimit one_thread(1);
  const Times one_core = fastest(cloud);
  std::printf("| %zu | %zu | %s | %.0f | %.0f | %.0f |\n", cloud.points_mm.size(),
              check.triangle_count, check.manifold() && check.oriented() ? "yes" : "no",
              one_core.processor_ms, one_core.wall_ms, every_core.wall_ms);
}

}  // namespace
}  // namespace softscope

int main() {
  std::printf(
      "| points | triangles | manifold, oriented | processor time, one thread, ms | one thread, ms "
      "| %d threads, ms |\n|---|---|---|---|---|---|\n",
      softscope::threadCount());
  softscope::measure(57.9);  // 20 k points
  softscope::measure(49.4);  // 100 k
  softscope::measure(28.2);  // 300 k
  return 0;
}
