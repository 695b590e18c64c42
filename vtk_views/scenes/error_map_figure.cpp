// vtk_views/scenes/error_map_figure.cpp: grid of images, colour bars below.
#include "vtk_views/scenes/error_map_figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/scenes/map_view.h"
#include "vtk_views/scenes/surface_picture.h"

namespace softscope {
namespace {

constexpr double kHeightShare = 0.72;  // height of a cell over its width
constexpr double kSideRoom = 1.6;      // space for side names, in units of the font size
constexpr double kPixelsPerPt = 2.2;   // 160 dots per inch
constexpr double kPushShare = 0.03;    // depth offset of the reference, as a share of its size
constexpr Rgb8 kReference{200, 200, 200};

/// Also computes the width that contains nearly all of the surface in an image
/// of this shape, with `side_share` of the width at each side for letters.
ViewPlane cameraOf(const ErrorMap& map, double height_share, double side_share, double& width_mm) {
  const Eigen::Matrix3d axes = viewAxes(map).cast<double>();
  const Eigen::AlignedBox3d box = mostOfPoints(map, {&map}).cast<double>();
  width_mm = std::max({box.sizes().x() / (1 - 2 * side_share),
                       box.sizes().y() / (height_share - 2 * side_share), 1e-3});
  ViewPlane camera;
  camera.right = axes.col(0);
  camera.up = axes.col(1);
  camera.centre_mm = axes * box.center();
  return camera;
}

std::vector<SceneSurface> surfacesOf(const ErrorMapCell& cell) {
  const ErrorMap& map = *cell.map;
  std::vector<SceneSurface> surfaces;
  if (!map.reference.empty()) {
    SceneSurface reference;
    reference.mesh = map.reference;
    reference.colour = kReference;
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : map.reference.vertices_mm) box.extend(p);
    const auto push_mm = static_cast<float>(kPushShare) * box.diagonal().norm();
    for (Eigen::Vector3f& p : reference.mesh.vertices_mm) p += push_mm * map.look.normalized();
    surfaces.push_back(std::move(reference));
  }
  SceneSurface surface;
  surface.mesh = map.surface;
  const std::vector<float>& errors = cell.with_sign ? map.signed_mm : map.absolute_mm;
  surface.errors_mm.assign(errors.begin(), errors.end());
  surfaces.push_back(std::move(surface));
  return surfaces;
}

void drawLabel(PointPt at, const std::string& words, TextAnchor anchor, double font_pt,
               VectorDrawing& drawing) {
  DrawnText text;
  text.at = at;
  text.text = words;
  text.size_pt = font_pt;
  text.anchor = anchor;
  text.rim = Rgb8{255, 255, 255};  // readable over the reference
  drawing.parts.emplace_back(std::move(text));
}

/// Letters of the patient's sides at the right and upper edge, if the space is known.
void drawSides(const ErrorMap& map, const ViewPlane& camera, PointPt from, PointPt to,
               double font_pt, VectorDrawing& drawing) {
  if (map.surface.space.empty()) return;
  const auto name = [&](Eigen::Vector3d direction) {
    if (map.surface.space == "RAS") direction.head<2>() *= -1;
    return sideName(direction, SceneFrame::kPatient);
  };
  drawLabel({to.x_pt - 3, (from.y_pt + to.y_pt) / 2}, name(camera.right), TextAnchor::kEnd, font_pt,
            drawing);
  drawLabel({(from.x_pt + to.x_pt) / 2, from.y_pt + 1.2 * font_pt}, name(camera.up),
            TextAnchor::kMiddle, font_pt, drawing);
}

/// Scale bar: the longest of 1, 2, 5, 10, … mm of at most
/// a quarter of the width; above the image, right-aligned.
void drawRuler(double pt_per_mm, PointPt from, PointPt to, double font_pt, VectorDrawing& drawing) {
  const double most_mm = (to.x_pt - from.x_pt) / 4 / pt_per_mm;
  const double power = std::pow(10.0, std::floor(std::log10(most_mm)));
  double length_mm = power;
  for (const double leading : {2.0, 5.0})
    if (leading * power <= most_mm) length_mm = leading * power;
  const double left = to.x_pt - length_mm * pt_per_mm, y_pt = from.y_pt - 0.75 * font_pt;
  drawing.parts.emplace_back(DrawnLine{{{left, y_pt}, {to.x_pt, y_pt}}, 1.5, {20, 20, 20}});
  char words[32];
  std::snprintf(words, sizeof words, "%g mm", length_mm);
  drawLabel({left - 0.4 * font_pt, from.y_pt - 0.5 * font_pt}, words, TextAnchor::kEnd, font_pt,
            drawing);
}

void drawCell(const ErrorMapCell& cell, int index, PointPt top_left, double width_pt,
              const ErrorMapFigureStyle& style, VectorDrawing& drawing) {
  const double height_pt = kHeightShare * width_pt, title_pt = 1.6 * style.font_pt;
  SurfacePictureOptions options;
  const ViewPlane camera =
      cameraOf(*cell.map, kHeightShare, kSideRoom * style.font_pt / width_pt, options.width_mm);
  options.width_px = static_cast<int>(std::lround(width_pt * kPixelsPerPt));
  options.height_px = static_cast<int>(std::lround(height_pt * kPixelsPerPt));
  options.point_size_mm = 1.7 * pointSpacingMm(*cell.map);
  const ColourImage picture =
      drawSurfaces(surfacesOf(cell), {cell.with_sign, style.limit_mm}, camera, options);
  const PointPt from{top_left.x_pt, top_left.y_pt + title_pt};
  const PointPt to{from.x_pt + width_pt, from.y_pt + height_pt};
  drawing.parts.emplace_back(DrawnPicture{from, to, picture});
  drawing.parts.emplace_back(DrawnLine{
      {from, {to.x_pt, from.y_pt}, to, {from.x_pt, to.y_pt}, from}, 0.4, {190, 190, 190}});
  drawSides(*cell.map, camera, from, to, style.font_pt, drawing);
  drawRuler(width_pt / options.width_mm, from, to, style.font_pt, drawing);
  DrawnText title;
  title.at = {top_left.x_pt, top_left.y_pt + 1.1 * style.font_pt};
  title.text = std::string("(") + static_cast<char>('a' + index % 26) + ") " + cell.title;
  title.size_pt = style.font_pt;
  title.bold = true;
  drawing.parts.emplace_back(title);
}

ColourBarText barText(const std::vector<ErrorMapCell>& cells, bool with_sign, double limit_mm) {
  ColourBarText text;
  text.label = with_sign ? "signed distance [mm], + = outside" : "distance [mm]";
  for (const ErrorMapCell& cell : cells) {
    if (cell.with_sign != with_sign) continue;
    for (const float e : with_sign ? cell.map->signed_mm : cell.map->absolute_mm) {
      text.any_above = text.any_above || double(e) > limit_mm;
      text.any_below = text.any_below || (with_sign && double(e) < -limit_mm);
    }
  }
  return text;
}

}  // namespace

VectorDrawing drawErrorMaps(const std::vector<ErrorMapCell>& cells,
                            const ErrorMapFigureStyle& style) {
  if (cells.empty()) throw Error("error maps: at least one");
  const int columns = std::clamp(style.columns, 1, static_cast<int>(cells.size()));
  const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
  VectorDrawing drawing;
  drawing.width_pt = style.width_mm * kPtPerMm;
  const double gap_pt = style.font_pt;
  const double width_pt = (drawing.width_pt - (columns - 1) * gap_pt) / columns;
  const double row_pt = kHeightShare * width_pt + 1.6 * style.font_pt + gap_pt;
  drawing.height_pt = rows * row_pt + colourBarHeightPt(style.font_pt) + 0.5 * style.font_pt;
  for (int i = 0; i < static_cast<int>(cells.size()); ++i)
    drawCell(cells[static_cast<std::size_t>(i)], i,
             {i % columns * (width_pt + gap_pt), i / columns * row_pt}, width_pt, style, drawing);
  const double half_pt = (drawing.width_pt - gap_pt) / 2;
  double x_pt = 0;
  for (const bool with_sign : {false, true}) {
    if (std::none_of(cells.begin(), cells.end(),
                     [&](const ErrorMapCell& c) { return c.with_sign == with_sign; }))
      continue;
    drawColourBar({with_sign, style.limit_mm}, barText(cells, with_sign, style.limit_mm),
                  {x_pt, rows * row_pt}, half_pt, style.font_pt, drawing);
    x_pt += half_pt + gap_pt;
  }
  return drawing;
}

}  // namespace softscope
