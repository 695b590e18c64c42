// tests/bench/bench_surface_distance.cpp: distances from points to surfaces, compared with VTK (and
// Embree if installed): times and differences, as tables for docs/benchmarks.md.
// SOFTSCOPE_TEST_DATA=… build/release/tests/bench/bench_surface_distance
#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "bench/embree_distance.h"
#include "core/parallel.h"
#include "eval/distance/triangle_tree.h"
#include "eval/made_shapes.h"
#include "mesh/mesh_reader.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

constexpr int kPoints = 100000;
using Points = std::vector<Eigen::Vector3f>;

/// The best of several runs, ms: what the machine can do when left alone.
double bestOf(int runs, const std::function<void()>& body) {
  double best_ms = HUGE_VAL;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    body();
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - start;
    best_ms = std::min(best_ms, spent.count());
  }
  return best_ms;
}

vtkNew<vtkPolyData> toVtk(const TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3f& v : mesh.vertices_mm) points->InsertNextPoint(v.x(), v.y(), v.z());
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : mesh.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

/// Distances with the locator, on as many threads as are allowed.
void locatorDistances(vtkStaticCellLocator* locator, const Points& points,
                      std::vector<double>& distances_mm) {
  parallelRanges(static_cast<int>(points.size()), 512, [&](int begin, int end) {
    vtkNew<vtkGenericCell> cell;
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector3d p = points[i].cast<double>();
      double closest[3], distance2 = 0;
      vtkIdType id = 0;
      int sub_id = 0;
      locator->FindClosestPoint(p.data(), closest, cell, id, sub_id, distance2);
      distances_mm[i] = std::sqrt(distance2);
    }
  });
}

/// Difference of the distances of another library, and number
/// of different signs (of points that are not on the surface).
void printDifference(const char* who, const std::vector<ClosestPoint>& ours,
                     const std::vector<double>& theirs_mm, bool with_sign) {
  double largest_mm = 0;
  int signs = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    largest_mm = std::max(largest_mm, std::abs(ours[i].distance_mm - std::abs(theirs_mm[i])));
    signs += with_sign && ours[i].distance_mm > 1e-6 &&
             (ours[i].signed_distance_mm < 0) != (theirs_mm[i] < 0);
  }
  std::printf("%s: largest difference %.1e mm", who, largest_mm);
  if (with_sign) std::printf(", %d of %zu signs differ", signs, ours.size());
  std::printf("\n");
}

struct Row {
  std::string what;
  double build_ms, one_ms, two_ms;  // NaN where it can't
};

void print(const Row& row) {
  std::printf("| %s | %.1f | %.1f |", row.what.c_str(), row.build_ms, row.one_ms);
  std::isnan(row.two_ms) ? std::printf(" – |\n") : std::printf(" %.1f |\n", row.two_ms);
}

double onThreads(int threads, int runs, const std::function<void()>& body) {
  const ThreadLimit limit(threads);
  return bestOf(runs, body);
}

void benchOurs(const TriangleMesh& mesh, const Points& points) {
  const TriangleTree tree(mesh);
  const double build_one_ms = onThreads(1, 9, [&] { TriangleTree built(mesh); });
  const double build_two_ms = onThreads(2, 9, [&] { TriangleTree built(mesh); });
  const auto sets = allTreeKernels();
  for (int i = 0; i < sets.count; ++i) {
    const auto query = [&] { tree.closestPoints(points, *sets.sets[i]); };
    print({std::string("softscope, signed, ") + sets.sets[i]->name, build_one_ms,
           onThreads(1, 9, query), onThreads(2, 9, query)});
  }
  std::printf("| (softscope's build on two threads) | %.1f | | |\n", build_two_ms);
}

void benchVtk(const TriangleMesh& mesh, const Points& points,
              const std::vector<ClosestPoint>& ours) {
  const vtkNew<vtkPolyData> surface = toVtk(mesh);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surface);
  std::vector<double> distances_mm(points.size());
  const auto unsigned_query = [&] { locatorDistances(locator, points, distances_mm); };
  const double build_ms = bestOf(1, [&] { locator->BuildLocator(); });
  print({"vtkStaticCellLocator, unsigned", build_ms, onThreads(1, 2, unsigned_query),
         onThreads(2, 2, unsigned_query)});

  vtkNew<vtkImplicitPolyDataDistance> implicit;
  std::vector<double> signed_mm(points.size());
  const double set_ms = bestOf(1, [&] { implicit->SetInput(surface); });
  print({"vtkImplicitPolyDataDistance, signed", set_ms,
         bestOf(2,
                [&] {
                  for (std::size_t i = 0; i < points.size(); ++i) {
                    Eigen::Vector3d p = points[i].cast<double>();
                    signed_mm[i] = implicit->EvaluateFunction(p.data());
                  }
                }),
         std::nan("")});
  printDifference("vtkStaticCellLocator", ours, distances_mm, false);
  printDifference("vtkImplicitPolyDataDistance", ours, signed_mm, true);
}

void benchEmbree(const TriangleMesh& mesh, const Points& points,
                 const std::vector<ClosestPoint>& ours) {
  const auto embree = makeEmbreeDistance(mesh);
  if (!embree) return;
  std::vector<double> distances_mm(points.size());
  const auto query = [&] {
    parallelRanges(static_cast<int>(points.size()), 512, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) distances_mm[i] = embree->distance(points[i]);
    });
  };
  print({"Embree, unsigned", onThreads(1, 5, [&] { makeEmbreeDistance(mesh); }),
         onThreads(1, 5, query), onThreads(2, 5, query)});
  printDifference("Embree", ours, distances_mm, false);
}

void bench(const std::string& name, const TriangleMesh& mesh, const Points& points) {
  std::printf("\n%s: %zu triangles, %zu points\n\n", name.c_str(), mesh.triangles.size(),
              points.size());
  std::printf("| what | build ms | query ms, 1 thread | 2 threads |\n|---|---|---|---|\n");
  const std::vector<ClosestPoint> ours = TriangleTree(mesh).closestPoints(points);
  benchOurs(mesh, points);
  benchEmbree(mesh, points, ours);
  benchVtk(mesh, points, ours);
}

int run() {
  std::mt19937 random(1);
  const TriangleMesh organ = makeOrgan(250, 198);
  bench("made organ, points within 0.5 mm", organ, pointsNear(organ, kPoints, 0.5f, random));
  bench("made organ, points within 10 mm", organ, pointsNear(organ, kPoints, 10, random));
  const auto folder = dataFolder("openhelp");
  if (folder.empty()) std::printf("\nno openhelp: set SOFTSCOPE_TEST_DATA for the organs\n");
  if (folder.empty()) return 0;
  for (const char* name : {"Heart.stl", "Liver.stl"}) {
    const TriangleMesh mesh = readMesh(folder / name);
    bench(std::string(name) + ", points within 0.5 mm", mesh,
          pointsNear(mesh, kPoints, 0.5f, random));
  }
  return 0;
}

}  // namespace
}  // namespace softscope::test

int main() { return softscope::test::run(); }
