// vtk_views/scenes/surface_picture.cpp: one actor
// per surface, one renderer, supersampling.
#include "vtk_views/scenes/surface_picture.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>

#include "core/error.h"
#include "vtk_views/scenes/offscreen_window.h"
#include "vtk_views/scenes/point_spacing.h"
#include "vtk_views/scenes/point_splats.h"
#include "vtk_views/scenes/surface_actor.h"
#include "vtk_views/scenes/view_camera.h"
#include "vtk_views/scenes/window_pixels.h"

namespace softscope {
namespace {

constexpr int kFiner = 2;                                           // supersampling factor per axis
constexpr double kNearer = 0.02;                                    // in image widths
constexpr double kEyeAway = 100;                                    // in image widths
constexpr double kSmallestDot = 1 / 150.0, kLargestDot = 1 / 50.0;  // in image widths

/// Sparse points are drawn as dots.
double pointSizeMm(const SceneSurface& surface, const SurfacePictureOptions& options) {
  if (options.point_size_mm > 0 || !surface.isPoints()) return options.point_size_mm;
  return std::clamp(dotSizeMm(surface.mesh.vertices_mm), kSmallestDot * options.width_mm,
                    kLargestDot * options.width_mm);
}

/// Dense points become splats, which can be shaded.
SceneSurface piecesOf(const SceneSurface& surface, const ViewPlane& camera,
                      const SurfacePictureOptions& options) {
  if (options.point_size_mm > 0 || !surface.isPoints() ||
      dotSizeMm(surface.mesh.vertices_mm) > kLargestDot * options.width_mm)
    return surface;
  const Eigen::Vector3d eye_mm =
      camera.centre_mm + kEyeAway * options.width_mm * camera.towardsViewer();
  return splatsOf(surface, 1, eye_mm.cast<float>());
}

}  // namespace

ColourImage drawSurfaces(const std::vector<SceneSurface>& surfaces, const ErrorColours& colours,
                         const ViewPlane& camera, const SurfacePictureOptions& options) {
  const double pixels_per_mm = kFiner * options.width_px / options.width_mm;
  const bool with_errors = std::any_of(surfaces.begin(), surfaces.end(),
                                       [](const auto& s) { return !s.errors_mm.empty(); });
  const Eigen::Vector3d shift_mm =
      std::max(kNearer * options.width_mm, with_errors ? 2 * colours.limit_mm : 0) *
      camera.towardsViewer();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SceneSurface& surface = surfaces[i];
    if (!surface.errors_mm.empty() && surface.errors_mm.size() != surface.mesh.vertices_mm.size())
      throw Error("error map: every vertex needs one error");
    SurfaceRole role;
    role.unlit = surface.isPoints() && !surface.mesh.colours.empty();
    role.point_size_px = std::max(1.0, pointSizeMm(surface, options) * pixels_per_mm);
    role.see_through = options.see_through && i == 0 && surfaces.size() > 1 && !with_errors;
    role.neutral = with_errors && surface.errors_mm.empty();
    if (i > 0) role.shift_mm = shift_mm;
    renderer->AddActor(surfaceActor(piecesOf(surface, camera, options), colours, role));
  }
  const auto window = makeOffscreenWindow(kFiner * options.width_px, kFiner * options.height_px);
  window->AddRenderer(renderer);
  const double height_mm = options.width_mm * options.height_px / options.width_px;
  aimParallel(renderer, camera, height_mm, 4 * std::max(options.width_mm, height_mm));
  window->Render();
  return readPixels(window, options.width_px, options.height_px, kFiner);
}

}  // namespace softscope
