// vtk_views/scenes/slice_panel.cpp: image, lines, dots, letters, scale bar.
#include "vtk_views/scenes/slice_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "vtk_views/scenes/clip_line.h"
#include "vtk_views/scenes/plane_contours.h"
#include "vtk_views/scenes/slice_picture.h"

namespace softscope {
namespace {

constexpr int kLeastPicturePx = 400;  // per side, if the resolution of the page allows it
constexpr Rgb8 kOnCt{255, 255, 255}, kOnWhite{40, 40, 40};

/// Resolution of the page, at most two pixels per voxel.
int pixelsOf(double length_pt, double length_mm, const Volume& volume, const FigureStyle& style) {
  const auto& spacing = volume.facts.spacing_mm;
  const double finest_mm = *std::min_element(spacing.begin(), spacing.end()) / 2;
  const double dots = length_pt / 72 * style.dots_per_inch;
  const double useful = std::max<double>(kLeastPicturePx, length_mm / finest_mm);
  return std::max(1, static_cast<int>(std::lround(std::min(dots, useful))));
}

PointPt onPage(const Eigen::Vector2d& p_mm, double width_mm, const PanelPlace& place) {
  const double height_mm = width_mm * place.height_pt / place.width_pt;
  return place.at(p_mm.x() / width_mm, p_mm.y() / height_mm);
}

void drawContour(const SceneSurface& surface, const ViewPlane& plane, double width_mm,
                 const PanelPlace& place, double line_pt, Rgb8 colour, VectorDrawing& drawing) {
  const Eigen::Vector2d half =
      Eigen::Vector2d(width_mm, width_mm * place.height_pt / place.width_pt) / 2;
  for (const ContourLine& contour :
       planeContours(surface.mesh, SectionPlane{plane.centre_mm, plane.towardsViewer()})) {
    std::vector<Eigen::Vector2d> line;
    for (const Eigen::Vector3f& p : contour) line.push_back(plane.project(p.cast<double>()));
    for (const auto& piece : clipLine(line, half)) {
      DrawnLine drawn;
      drawn.width_pt = line_pt;
      drawn.colour = colour;
      for (const Eigen::Vector2d& p : piece) drawn.points.push_back(onPage(p, width_mm, place));
      drawing.parts.emplace_back(std::move(drawn));
    }
  }
}

void drawDots(const SceneSurface& surface, const ViewPlane& plane, double reach_mm, double width_mm,
              const PanelPlace& place, double line_pt, Rgb8 colour, VectorDrawing& drawing) {
  const SectionPlane cut{plane.centre_mm, plane.towardsViewer()};
  const double half_height_mm = width_mm * place.height_pt / place.width_pt / 2;
  DrawnDots dots;
  dots.diameter_pt = surface.dot_scale * line_pt;
  dots.colour = colour;
  for (const Eigen::Vector3f& p : pointsNearPlane(surface.mesh.vertices_mm, cut, reach_mm)) {
    const Eigen::Vector2d at = plane.project(p.cast<double>());
    if (std::abs(at.x()) <= width_mm / 2 && std::abs(at.y()) <= half_height_mm)
      dots.centres.push_back(onPage(at, width_mm, place));
  }
  if (!dots.centres.empty()) drawing.parts.emplace_back(std::move(dots));
}

void drawVolume(const Scene& scene, const ViewPlane& plane, double width_mm,
                const PanelPlace& place, const FigureStyle& style, VectorDrawing& drawing) {
  const SliceField field{width_mm, width_mm * place.height_pt / place.width_pt};
  drawing.parts.emplace_back(
      DrawnPicture{place.top_left,
                   {place.right(), place.bottom()},
                   slicePicture(*scene.volume, plane, field, scene.window,
                                pixelsOf(place.width_pt, field.width_mm, *scene.volume, style),
                                pixelsOf(place.height_pt, field.height_mm, *scene.volume, style))});
}

}  // namespace

double scaleBarLengthMm(double width_mm) {
  const double rough = width_mm / 4;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double leading = rough / power;
  return (leading >= 5 ? 5 : (leading >= 2 ? 2 : 1)) * power;
}

void drawSideNames(const ViewPlane& plane, SceneFrame frame, const PanelPlace& place, Rgb8 colour,
                   const FigureStyle& style, VectorDrawing& drawing) {
  DrawnText text;
  text.size_pt = style.font_pt;
  text.bold = frame == SceneFrame::kPatient;
  text.colour = colour;
  text.rim = colour == kOnCt ? Rgb8{0, 0, 0} : Rgb8{255, 255, 255};
  const double inset_pt = 0.35 * style.font_pt, half_pt = 0.36 * style.font_pt;
  const auto put = [&](const Eigen::Vector3d& direction, PointPt at, TextAnchor anchor) {
    text.text = sideName(direction, frame);
    text.at = at;
    text.anchor = anchor;
    drawing.parts.emplace_back(text);
  };
  const PointPt middle = place.at(0, 0);
  // Words are vertical at the sides, where they need the space of a letter.
  text.upwards = frame == SceneFrame::kCamera;
  if (text.upwards) {
    put(plane.right, {place.right() - inset_pt, middle.y_pt}, TextAnchor::kMiddle);
    put(-plane.right, {place.top_left.x_pt + inset_pt + 2 * half_pt, middle.y_pt},
        TextAnchor::kMiddle);
  } else {
    put(plane.right, {place.right() - inset_pt, middle.y_pt + half_pt}, TextAnchor::kEnd);
    put(-plane.right, {place.top_left.x_pt + inset_pt, middle.y_pt + half_pt}, TextAnchor::kStart);
  }
  text.upwards = false;
  put(plane.up, {middle.x_pt, place.top_left.y_pt + inset_pt + 2 * half_pt}, TextAnchor::kMiddle);
  put(-plane.up, {middle.x_pt, place.bottom() - inset_pt}, TextAnchor::kMiddle);
}

void drawScaleBar(double width_mm, const PanelPlace& place, Rgb8 colour, const FigureStyle& style,
                  VectorDrawing& drawing) {
  const double length_mm = scaleBarLengthMm(width_mm);
  const double length_pt = length_mm / width_mm * place.width_pt;
  const PointPt left{place.top_left.x_pt + 0.5 * style.font_pt,
                     place.bottom() - 0.5 * style.font_pt};
  const PointPt right{left.x_pt + length_pt, left.y_pt};
  const double thick_pt = std::max(1.2, 1.5 * style.line_pt);
  const Rgb8 rim = colour == kOnCt ? Rgb8{0, 0, 0} : Rgb8{255, 255, 255};
  drawing.parts.emplace_back(
      DrawnLine{{{left.x_pt - 0.5, left.y_pt}, {right.x_pt + 0.5, right.y_pt}}, thick_pt + 1, rim});
  drawing.parts.emplace_back(DrawnLine{{left, right}, thick_pt, colour});
  char label[32];
  std::snprintf(label, sizeof label, "%g mm", length_mm);
  DrawnText text;
  text.at = {left.x_pt, left.y_pt - 0.45 * style.font_pt};
  text.text = label;
  text.size_pt = 0.9 * style.font_pt;
  text.colour = colour;
  text.rim = colour == kOnCt ? Rgb8{0, 0, 0} : Rgb8{255, 255, 255};
  drawing.parts.emplace_back(text);
}

void drawPanelFrame(const PanelPlace& place, VectorDrawing& drawing) {
  const PointPt a = place.top_left, b{place.right(), place.bottom()};
  drawing.parts.emplace_back(
      DrawnLine{{a, {b.x_pt, a.y_pt}, b, {a.x_pt, b.y_pt}, a}, 0.5, {90, 90, 90}});
}

void drawSlicePanel(const Scene& scene, const ViewPlane& plane, double width_mm,
                    const PanelPlace& place, const FigureStyle& style, VectorDrawing& drawing) {
  const bool on_ct = scene.volume.has_value();
  if (on_ct) drawVolume(scene, plane, width_mm, place, style, drawing);
  for (const SceneSurface& surface : scene.surfaces) {
    const Rgb8 colour = on_ct ? surface.colour : onWhite(surface.colour);
    if (surface.isPoints())
      drawDots(surface, plane, scene.dot_reach_mm, width_mm, place, style.line_pt, colour, drawing);
    else
      drawContour(surface, plane, width_mm, place, surface.dot_scale * style.line_pt, colour,
                  drawing);
  }
  if (!on_ct) drawPanelFrame(place, drawing);
  drawSideNames(plane, scene.frame, place, on_ct ? kOnCt : kOnWhite, style, drawing);
  drawScaleBar(width_mm, place, on_ct ? kOnCt : kOnWhite, style, drawing);
}

}  // namespace softscope
