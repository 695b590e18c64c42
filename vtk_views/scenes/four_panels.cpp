// vtk_views/scenes/four_panels.cpp: slice or 3-D image per panel.
#include "vtk_views/scenes/four_panels.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "vtk_views/scenes/surface_picture.h"

namespace softscope {
namespace {

constexpr double kRoomAround = 1.4;  // in units of the longest side of the surfaces
constexpr int kMost3dPx = 800;       // per side
constexpr Rgb8 kDark{40, 40, 40};

FigureFoot footOf(const Scene& scene, const PanelOptions& options) {
  FigureFoot foot = options.foot;
  if (foot.legend.empty()) foot.legend = legendOf(scene);
  return foot;
}

double panelWidthPt(std::size_t count, const PanelOptions& options, const FigureFoot& foot) {
  return layOutPanels(count, options.columns, options.style, foot).panels[0].width_pt;
}

std::vector<SceneSurface> surfacesIn3d(const Scene& scene) {
  std::vector<SceneSurface> surfaces;
  for (const SceneSurface& surface : scene.surfaces)
    if (surface.in_3d) surfaces.push_back(surface);
  return surfaces;
}

void draw3d(const Scene& scene, const ViewPlane& camera, double width_mm,
            const PanelOptions& options, const PanelPlace& place, VectorDrawing& drawing) {
  SurfacePictureOptions picture;
  const double wanted_px = place.width_pt / 72 * options.style.dots_per_inch;
  picture.width_px = std::clamp(static_cast<int>(std::lround(wanted_px)), 50, kMost3dPx);
  picture.height_px = picture.width_px;
  picture.width_mm = width_mm;
  picture.see_through = true;
  drawing.parts.emplace_back(
      DrawnPicture{place.top_left,
                   {place.right(), place.bottom()},
                   drawSurfaces(surfacesIn3d(scene), options.foot.colours.value_or(ErrorColours{}),
                                camera, picture)});
  drawPanelFrame(place, drawing);
  drawSideNames(camera, scene.frame, place, kDark, options.style, drawing);
  drawScaleBar(width_mm, place, kDark, options.style, drawing);
}

std::string captionOf(const ViewPlane& plane, SceneFrame frame) {
  const std::string position = positionText(plane, frame);
  return position.empty() ? plane.name : plane.name + ", " + position;
}

std::vector<SceneSurface> focusOf(const Scene& scene) {
  std::vector<SceneSurface> focus;
  for (const SceneSurface& surface : scene.surfaces)
    if (surface.in_focus) focus.push_back(surface);
  return focus;
}

}  // namespace

Eigen::Vector3d sceneCentre(const Scene& scene) {
  const std::vector<SceneSurface> focus = focusOf(scene);
  if (!focus.empty()) return middleOf(focus).median_mm;
  const Eigen::AlignedBox3d box = boxOf(scene.surfaces);
  if (!box.isEmpty()) return box.center();
  if (!scene.volume) throw Error("figure: there is nothing to show");
  return boxOf(*scene.volume).center();
}

double sceneWidthMm(const Scene& scene) {
  const std::vector<SceneSurface> focus = focusOf(scene);
  const Eigen::AlignedBox3d box = boxOf(scene.surfaces);
  double width_mm = 1e9;
  if (!focus.empty())
    width_mm = kRoomAround * middleOf(focus).size_mm.maxCoeff();
  else if (!box.isEmpty())
    width_mm = kRoomAround * box.sizes().maxCoeff();
  if (scene.volume) width_mm = std::min(width_mm, boxOf(*scene.volume).sizes().maxCoeff());
  return std::max(width_mm, 1e-3);
}

PanelField fourViews(const Scene& scene, const FourPanelOptions& options) {
  const std::vector<ViewPlane> planes{axialView(options.centre_mm, scene.frame, options.rule),
                                      coronalView(options.centre_mm, scene.frame, options.rule),
                                      sagittalView(options.centre_mm, scene.frame),
                                      cameraView(sceneCentre(scene), options.eye, scene.frame)};
  if (options.width_mm > 0) return {planes, options.width_mm};
  const bool in_3d = !surfacesIn3d(scene).empty();
  std::vector<FieldView> views;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (i < 3 || in_3d) views.push_back({&scene, planes[i], /*is_3d=*/i == 3, 0});
  PanelField field = fitField(views, panelWidthPt(views.size(), options, footOf(scene, options)),
                              options.style, options.keep_centres);
  if (!in_3d) field.planes.push_back(planes[3]);
  return field;
}

PanelField sliceViews(const Scene& scene, const std::vector<ViewPlane>& planes,
                      const PanelOptions& options) {
  if (options.width_mm > 0) return {planes, options.width_mm};
  std::vector<FieldView> views;
  for (const ViewPlane& plane : planes) views.push_back({&scene, plane, false, 0});
  return fitField(views, panelWidthPt(planes.size(), options, footOf(scene, options)),
                  options.style, options.keep_centres);
}

VectorDrawing drawFourPanels(const Scene& scene, const FourPanelOptions& options) {
  const FigureFoot foot = footOf(scene, options);
  const bool in_3d = !surfacesIn3d(scene).empty();
  const PanelGrid grid = layOutPanels(in_3d ? 4 : 3, options.columns, options.style, foot);
  VectorDrawing drawing = newSheet(grid);
  const PanelField field = fourViews(scene, options);
  const std::vector<ViewPlane>& views = field.planes;
  for (std::size_t i = 0; i < 3; ++i) {
    drawSlicePanel(scene, views[i], field.width_mm, grid.panels[i], options.style, drawing);
    drawCaption(i, captionOf(views[i], scene.frame), grid.panels[i], options.style, drawing);
  }
  if (in_3d) {
    draw3d(scene, views[3], field.width_mm, options, grid.panels[3], drawing);
    drawCaption(3, views[3].name, grid.panels[3], options.style, drawing);
  }
  drawFoot(foot, grid, options.style, drawing);
  return drawing;
}

VectorDrawing drawSlices(const Scene& scene, const std::vector<ViewPlane>& planes,
                         const PanelOptions& options) {
  const FigureFoot foot = footOf(scene, options);
  const PanelGrid grid = layOutPanels(planes.size(), options.columns, options.style, foot);
  VectorDrawing drawing = newSheet(grid);
  const PanelField field = sliceViews(scene, planes, options);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    drawSlicePanel(scene, field.planes[i], field.width_mm, grid.panels[i], options.style, drawing);
    drawCaption(i, captionOf(planes[i], scene.frame), grid.panels[i], options.style, drawing);
  }
  drawFoot(foot, grid, options.style, drawing);
  return drawing;
}

VectorDrawing drawScenes(const std::vector<ScenePanel>& panels, const PanelOptions& options) {
  const FigureFoot foot = footOf(*panels.at(0).scene, options);
  const PanelGrid grid = layOutPanels(panels.size(), options.columns, options.style, foot);
  VectorDrawing drawing = newSheet(grid);
  PanelField field{{}, options.width_mm};
  std::vector<FieldView> views;
  for (const ScenePanel& panel : panels) {
    views.push_back({panel.scene, panel.camera, /*is_3d=*/true, panel.world});
    field.planes.push_back(panel.camera);
  }
  if (!(field.width_mm > 0))
    field = fitField(views, grid.panels[0].width_pt, options.style, options.keep_centres);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    draw3d(*panels[i].scene, field.planes[i], field.width_mm, options, grid.panels[i], drawing);
    drawCaption(i, panels[i].caption, grid.panels[i], options.style, drawing);
  }
  drawFoot(foot, grid, options.style, drawing);
  return drawing;
}

}  // namespace softscope
