// vtk_views/four_panels.cpp: a grid of panels, captions below them, legend and bar at the foot.
#include "vtk_views/four_panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "vtk_views/plot_axes.h"
#include "vtk_views/slice_panel.h"
#include "vtk_views/surface_picture.h"

namespace softscope {
namespace {

constexpr double kGapMm = 1.5;
constexpr double kFourInARowMm = 140;  // below, panels get too small
constexpr double kCaption = 1.7;       // in heights of letters
constexpr double kLegendRow = 1.7;
constexpr double kRoomAround = 1.4;  // of the surfaces' longest side
constexpr int kMost3dPx = 1100;

struct Layout {
  double width_pt, height_pt;
  std::array<PanelPlace, 4> panels;
  double foot_pt;  // where legend and bar begin
};

std::vector<LegendEntry> legendOf(const Scene& scene) {
  std::vector<LegendEntry> entries;
  for (const SceneSurface& surface : scene.surfaces)
    if (!surface.name.empty())
      entries.push_back({surface.name, surface.colour, surface.isPoints()});
  return entries;
}

double entryWidthPt(const LegendEntry& entry, double font_pt) {
  DrawnText text;
  text.text = entry.meaning;
  text.size_pt = font_pt;
  return textWidthPt(text) + 4.2 * font_pt;
}

/// Rows of entries that fit the width.
std::vector<std::vector<LegendEntry>> legendRows(const Scene& scene, double width_pt,
                                                 double font_pt) {
  std::vector<std::vector<LegendEntry>> rows;
  double used_pt = width_pt + 1;
  for (const LegendEntry& entry : legendOf(scene)) {
    const double needed_pt = entryWidthPt(entry, font_pt);
    if (used_pt + needed_pt > width_pt) {
      rows.emplace_back();
      used_pt = 0;
    }
    rows.back().push_back(entry);
    used_pt += needed_pt;
  }
  return rows;
}

Layout layOut(const Scene& scene, const FourPanelOptions& options) {
  const FigureStyle& style = options.style;
  const int columns =
      options.columns > 0 ? options.columns : (style.width_mm >= kFourInARowMm ? 4 : 2);
  const double gap_pt = kGapMm * kPtPerMm, caption_pt = kCaption * style.font_pt;
  Layout layout;
  layout.width_pt = style.width_mm * kPtPerMm;
  const double side_pt = (layout.width_pt - (columns - 1) * gap_pt) / columns;
  for (int i = 0; i < 4; ++i)
    layout.panels[std::size_t(i)] = {
        {(i % columns) * (side_pt + gap_pt), (i / columns) * (side_pt + caption_pt + 0.5 * gap_pt)},
        side_pt,
        side_pt};
  layout.foot_pt = layout.panels[3].bottom() + caption_pt + 0.5 * gap_pt;
  layout.height_pt = layout.foot_pt;
  layout.height_pt +=
      double(legendRows(scene, layout.width_pt, style.font_pt).size()) * kLegendRow * style.font_pt;
  if (options.colours) layout.height_pt += colourBarHeightPt(style.font_pt) + 0.3 * style.font_pt;
  return layout;
}

void drawCaption(int index, const ViewPlane& view, SceneFrame frame, const PanelPlace& place,
                 const FigureStyle& style, VectorDrawing& drawing) {
  const std::string position = view.name == "3-D" ? "" : positionText(view, frame);
  DrawnText text;
  text.at = {place.top_left.x_pt, place.bottom() + 1.2 * style.font_pt};
  text.text = std::string("(") + char('a' + index) + ") " + view.name +
              (position.empty() ? "" : ", " + position);
  text.size_pt = style.font_pt;
  drawing.parts.emplace_back(text);
}

void draw3d(const Scene& scene, const ViewPlane& camera, const FourPanelOptions& options,
            const PanelPlace& place, VectorDrawing& drawing) {
  SurfacePictureOptions picture;
  const double wanted_px = place.width_pt / 72 * options.style.dots_per_inch;
  picture.width_px = std::clamp(static_cast<int>(std::lround(wanted_px)), 50, kMost3dPx);
  picture.height_px = picture.width_px;
  picture.width_mm = options.width_mm;
  picture.point_size_mm = options.width_mm / 200;
  picture.see_through = true;
  drawing.parts.emplace_back(DrawnPicture{
      place.top_left,
      {place.right(), place.bottom()},
      drawSurfaces(scene.surfaces, options.colours.value_or(ErrorColours{}), camera, picture)});
  drawPanelFrame(place, drawing);
  drawSideNames(camera, scene.frame, place, {40, 40, 40}, options.style, drawing);
  drawScaleBar(options.width_mm, place, {40, 40, 40}, options.style, drawing);
}

void drawFoot(const Scene& scene, const FourPanelOptions& options, const Layout& layout,
              VectorDrawing& drawing) {
  const double font_pt = options.style.font_pt;
  double y_pt = layout.foot_pt;
  for (const auto& row : legendRows(scene, layout.width_pt, font_pt)) {
    drawLegend(row, {0, y_pt + 0.5 * kLegendRow * font_pt}, font_pt, drawing);
    y_pt += kLegendRow * font_pt;
  }
  if (options.colours)
    drawColourBar(*options.colours, options.bar, {0, y_pt + 0.3 * font_pt}, layout.width_pt,
                  font_pt, drawing);
}

}  // namespace

Eigen::Vector3d sceneCentre(const Scene& scene) {
  const Eigen::AlignedBox3d box = boxOf(scene.surfaces);
  if (!box.isEmpty()) return box.center();
  if (!scene.volume) throw Error("figure: there is nothing to show");
  return boxOf(*scene.volume).center();
}

double sceneWidthMm(const Scene& scene) {
  const Eigen::AlignedBox3d box = boxOf(scene.surfaces);
  double width_mm = box.isEmpty() ? 1e9 : kRoomAround * box.sizes().maxCoeff();
  if (scene.volume) width_mm = std::min(width_mm, boxOf(*scene.volume).sizes().maxCoeff());
  return std::max(width_mm, 1e-3);
}

VectorDrawing drawFourPanels(const Scene& scene, const FourPanelOptions& options) {
  const Layout layout = layOut(scene, options);
  VectorDrawing drawing;
  drawing.width_pt = layout.width_pt;
  drawing.height_pt = layout.height_pt;
  const std::array<ViewPlane, 3> planes{axialView(options.centre_mm, scene.frame, options.rule),
                                        coronalView(options.centre_mm, scene.frame, options.rule),
                                        sagittalView(options.centre_mm, scene.frame)};
  for (std::size_t i = 0; i < 3; ++i) {
    drawSlicePanel(scene, planes[i], options.width_mm, layout.panels[i], options.style, drawing);
    drawCaption(int(i), planes[i], scene.frame, layout.panels[i], options.style, drawing);
  }
  const ViewPlane camera = cameraView(sceneCentre(scene), options.eye, scene.frame);
  draw3d(scene, camera, options, layout.panels[3], drawing);
  drawCaption(3, camera, scene.frame, layout.panels[3], options.style, drawing);
  drawFoot(scene, options, layout, drawing);
  return drawing;
}

}  // namespace softscope
