// tests/bench/bench_figures.cpp: time of contours and figures, as tables for docs/benchmarks.md.
//   SOFTSCOPE_TEST_DATA=… build/release/tests/bench/bench_figures
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <vector>

#include "core/parallel.h"
#include "mesh/mesh_reader.h"
#include "vtk_views/scenes/four_panels.h"
#include "vtk_views/scenes/plane_contours.h"

namespace softscope {
namespace {

/// The fastest of several runs, so that other programs disturb least.
double fastestMs(int runs, const std::function<void()>& work) {
  double fastest_ms = 1e9;
  for (int k = 0; k < runs; ++k) {
    const auto start = std::chrono::steady_clock::now();
    work();
    fastest_ms =
        std::min(fastest_ms,
                 std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                     .count());
  }
  return fastest_ms;
}

/// A ball of 223 x 223 quads: 99 458 triangles.
TriangleMesh ball() {
  constexpr int kSteps = 223;
  TriangleMesh mesh;
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const double polar = M_PI * j / kSteps, turn = 2 * M_PI * i / kSteps;
      mesh.vertices_mm.emplace_back(float(60 * std::sin(polar) * std::cos(turn)),
                                    float(60 * std::sin(polar) * std::sin(turn)),
                                    float(60 * std::cos(polar)));
    }
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const int a = j * kSteps + i, b = j * kSteps + (i + 1) % kSteps;
      mesh.triangles.push_back({a, a + kSteps, b});
      mesh.triangles.push_back({b, a + kSteps, b + kSteps});
    }
  return mesh;
}

void timeContours() {
  const TriangleMesh mesh = ball();
  std::vector<SectionPlane> planes;
  for (int i = 0; i < 100; ++i)
    planes.push_back({{0, 0, -59.5 + 1.19 * i}, Eigen::Vector3d(0.1, 0.2, 1).normalized()});
  std::size_t points = 0;
  const auto cut = [&] {
    points = 0;
    for (const auto& lines : planeContours(mesh, planes))
      for (const ContourLine& line : lines) points += line.size();
  };
  const double all_ms = fastestMs(15, cut);
  const ThreadLimit one(1);
  const double one_ms = fastestMs(15, cut);
  std::printf("contours: %zu triangles, 100 planes, %zu points: %.1f ms, on one core %.1f ms\n",
              mesh.triangles.size(), points, all_ms, one_ms);
}

void timeFigure(const std::filesystem::path& ct) {
  Scene scene;
  const double read_ms =
      fastestMs(3, [&] { scene.volume = readVolume((ct / "chaos_dicom").string()); });
  scene.window = parseWindow("auto", *scene.volume);
  scene.surfaces.push_back(
      {"reference", readMesh(ct / "chaos_set3_liver_LPSmm.ply"), surfaceColour(0), {}});
  std::printf("DICOM folder, 78 slices of 512 x 512: %.0f ms\n", read_ms);
  for (const double width_mm : {88.9, 183.0})
    for (const double dots_per_inch : {300.0, 600.0}) {
      FourPanelOptions options;
      options.style.width_mm = width_mm;
      options.style.dots_per_inch = dots_per_inch;
      options.centre_mm = sceneCentre(scene);
      options.width_mm = sceneWidthMm(scene);
      VectorDrawing drawing;
      const double draw_ms = fastestMs(10, [&] { drawing = drawFourPanels(scene, options); });
      const double pixels_ms = fastestMs(5, [&] { rasterise(drawing, dots_per_inch); });
      const double pdf_ms = fastestMs(3, [&] { pdfBytes(drawing); });
      const double svg_ms = fastestMs(3, [&] { svgBytes(drawing); });
      std::printf("%.0f mm, %.0f dpi: draw %.0f, to pixels %.0f, PDF %.0f, SVG %.0f ms\n", width_mm,
                  dots_per_inch, draw_ms, pixels_ms, pdf_ms, svg_ms);
    }
}

}  // namespace
}  // namespace softscope

int main() {
  softscope::timeContours();
  const char* data = std::getenv("SOFTSCOPE_TEST_DATA");
  if (data == nullptr) return 0;
  softscope::timeFigure(std::filesystem::path(data) / "ct");
}
