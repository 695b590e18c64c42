// toolkit/comparison/compare_picture.cpp: two views with one colour bar and one line of statistics.
#include "toolkit/comparison/compare_picture.h"

#include <Eigen/Geometry>
#include <cmath>

#include "toolkit/record/statistics_json.h"
#include "vtk_views/scenes/four_panels.h"

namespace softscope {
namespace {

const Eigen::Vector3d kFromTheFront(0.45, -0.8, 0.4);
constexpr double kFacesOneSide = 0.3;  // length of the mean normal: 0 closed surface, 1 plane

/// Mean normal of the part of the reference near the test; zero for a closed surface.
Eigen::Vector3d meanNormal(const TriangleMesh& reference,
                           const std::vector<ClosestPoint>& closest) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const ClosestPoint& c : closest) {
    if (c.triangle < 0) continue;
    const Triangle& t = reference.triangles[std::size_t(c.triangle)];
    const Eigen::Vector3f& a = reference.vertices_mm[std::size_t(t[0])];
    const Eigen::Vector3f normal = (reference.vertices_mm[std::size_t(t[1])] - a)
                                       .cross(reference.vertices_mm[std::size_t(t[2])] - a);
    if (normal.norm() > 0) sum += normal.normalized().cast<double>();
    ++count;
  }
  return count == 0 ? kFromTheFront : Eigen::Vector3d(sum / double(count));
}

/// Both surfaces are in the space of the reference here; patient views are drawn in LPS.
TriangleMesh inLps(TriangleMesh mesh) {
  if (mesh.space == "RAS")
    for (Eigen::Vector3f& p : mesh.vertices_mm) p.head<2>() = -p.head<2>();
  return mesh;
}

Scene sceneOf(const TriangleMesh& reference, const TriangleMesh& test,
              const std::vector<double>& errors_mm) {
  Scene scene;
  scene.frame = reference.space.empty() ? SceneFrame::kAxes : SceneFrame::kPatient;
  TriangleMesh placed = test;
  placed.space = reference.space;
  scene.surfaces.push_back({"reference", inLps(reference), {175, 175, 175}, {}});
  scene.surfaces.push_back({"", inLps(placed), surfaceColour(1), errors_mm});
  scene.surfaces.back().in_focus = true;
  return scene;
}

/// Unobserved points are grey if an observed region is given.
SurfaceErrorMap mapOf(const ComparisonResult& result, const ErrorColourOptions& options) {
  std::vector<double> distance_mm, signed_mm;
  const auto& closest = result.comparison.closest;
  for (std::size_t i = 0; i < closest.size(); ++i) {
    const bool shown = !result.observed || result.observed->each_observed[i] != 0;
    distance_mm.push_back(shown ? closest[i].distance_mm : std::nan(""));
    signed_mm.push_back(shown ? closest[i].signed_distance_mm : std::nan(""));
  }
  return colourErrors(distance_mm, signed_mm, options);
}

ScenePanel panelFrom(const Eigen::Vector3d& eye, const Scene& scene) {
  return {&scene, cameraView(sceneCentre(scene), eye, scene.frame),
          "seen from " + sideName(eye, scene.frame)};
}

}  // namespace

Eigen::Vector3d comparisonEye(const TriangleMesh& reference,
                              const std::vector<ClosestPoint>& closest) {
  const Eigen::Vector3d eye = meanNormal(reference, closest);
  return eye.norm() < kFacesOneSide ? kFromTheFront : eye;
}

VectorDrawing drawComparison(const ComparisonResult& result, const TriangleMesh& reference,
                             const TriangleMesh& test, const ErrorColourOptions& options,
                             const FigureStyle& style) {
  const SurfaceErrorMap map = mapOf(result, options);
  const Scene scene = sceneOf(reference, test, map.each_mm);
  const Eigen::Vector3d eye = comparisonEye(inLps(reference), result.comparison.closest);
  PanelOptions panels;
  panels.style = style;
  map.explainIn(panels.foot);
  if (map.colours.with_sign && !result.observed) panels.foot.bar.missing = "beyond the border";
  panels.foot.legend = {{"reference", scene.surfaces[0].colour, /*filled=*/true}};
  const Statistics& errors = result.comparison.accuracy.vertices_mm;
  const Statistics& with_sign = result.comparison.signed_mm;
  const bool has_bias = map.colours.with_sign && with_sign.count > 0;
  const std::string bias =
      has_bias ? "signed mean " + fixed(with_sign.mean, 3) + " mm; absolute: " : "";
  panels.foot.notes = {bias + spreadText(errors), std::to_string(errors.count) +
                                                      " vertices; alignment: " + result.fit.method +
                                                      ". Research use only."};
  return drawScenes({panelFrom(eye, scene), panelFrom(-eye, scene)}, panels);
}

}  // namespace softscope
