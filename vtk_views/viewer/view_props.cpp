// vtk_views/viewer/view_props.cpp: lines, and images on rectangles.
#include "vtk_views/viewer/view_props.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/slice_picture.h"
#include "vtk_views/scenes/window_pixels.h"

namespace softscope {
namespace {

constexpr int kMostSlicePx = 768;

vtkSmartPointer<vtkPolyData> dataOf(const LineSet& lines) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [from, to] : lines.lines_mm) {
    const vtkIdType ends[] = {points->InsertNextPoint(from.data()),
                              points->InsertNextPoint(to.data())};
    cells->InsertNextCell(2, ends);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  return data;
}

/// Part of the plane inside the box of the volume, at most `side_mm` wide.
std::pair<ViewPlane, SliceField> fieldIn(const Volume& volume, ViewPlane plane, double side_mm) {
  const Eigen::AlignedBox3d box = boxOf(volume);
  const auto share = [&](const Eigen::Vector3d& along) {
    const double half = 0.5 * along.cwiseAbs().dot(box.sizes());
    const double middle = along.dot(box.center() - plane.centre_mm);
    return std::pair(std::max(middle - half, -side_mm / 2), std::min(middle + half, side_mm / 2));
  };
  const auto [left, right] = share(plane.right);
  const auto [bottom, top] = share(plane.up);
  plane.centre_mm += (left + right) / 2 * plane.right + (bottom + top) / 2 * plane.up;
  return {plane, {std::max(right - left, 1e-3), std::max(top - bottom, 1e-3)}};
}

}  // namespace

void redressLines(const LineSet& lines, vtkActor* actor) {
  vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(dataOf(lines));
  vtkProperty* look = actor->GetProperty();
  look->SetColor(lines.colour.red / 255.0, lines.colour.green / 255.0, lines.colour.blue / 255.0);
  look->SetLineWidth(float(lines.width_px));
  look->LightingOff();
}

vtkSmartPointer<vtkActor> lineActor(const LineSet& lines) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  actor->SetMapper(mapper);
  redressLines(lines, actor);
  return actor;
}

LineSet scopeLines(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left,
                   double depth_mm) {
  const auto place = [&](double u_px, double v_px) {
    return (world_from_left * liftPixel<double>(left, u_px, v_px, depth_mm)).cast<float>().eval();
  };
  const double right = left.width_px - 0.5, bottom = left.height_px - 0.5;
  const std::array<Eigen::Vector3f, 4> corners{place(-0.5, -0.5), place(right, -0.5),
                                               place(right, bottom), place(-0.5, bottom)};
  const Eigen::Vector3f eye = world_from_left.translation().cast<float>();
  LineSet set;
  set.colour = {20, 20, 20};
  for (std::size_t i = 0; i < 4; ++i) {
    set.lines_mm.emplace_back(eye, corners[i]);
    set.lines_mm.emplace_back(corners[i], corners[(i + 1) % 4]);
  }
  const Eigen::Vector3f tip = place(0.5 * left.width_px, -0.2 * left.height_px);
  set.lines_mm.emplace_back(place(0.35 * left.width_px, -0.5), tip);
  set.lines_mm.emplace_back(place(0.65 * left.width_px, -0.5), tip);
  return set;
}

LineSet pathLines(const std::vector<Eigen::Vector3f>& points_mm, Rgb8 colour) {
  LineSet set;
  set.colour = colour;
  set.width_px = 2;
  for (std::size_t i = 0; i + 1 < points_mm.size(); ++i)
    set.lines_mm.emplace_back(points_mm[i], points_mm[i + 1]);
  return set;
}

LineSet motionArrows(const std::vector<Eigen::Vector3f>& ends_mm,
                     const std::vector<Eigen::Vector3f>& motions_mm, double times, double least_mm,
                     Rgb8 colour) {
  LineSet set;
  set.colour = colour;
  set.width_px = 2;
  for (std::size_t i = 0; i < std::min(ends_mm.size(), motions_mm.size()); ++i) {
    const Eigen::Vector3f shaft = float(times) * motions_mm[i];
    if (!(motions_mm[i].norm() >= float(least_mm))) continue;
    const Eigen::Vector3f end = ends_mm[i], side = 0.1f * shaft.norm() * shaft.unitOrthogonal();
    set.lines_mm.emplace_back(end - shaft, end);
    set.lines_mm.emplace_back(end, end - 0.25f * shaft + side);
    set.lines_mm.emplace_back(end, end - 0.25f * shaft - side);
  }
  return set;
}

vtkSmartPointer<vtkActor> sliceActor(const Volume& volume, const ViewPlane& plane,
                                     const GreyWindow& window, double side_mm) {
  const auto [whole, field] = fieldIn(volume, plane, side_mm);
  const double finest_mm =
      *std::min_element(volume.facts.spacing_mm.begin(), volume.facts.spacing_mm.end());
  const auto pixels = [&](double length_mm) {
    return std::clamp(static_cast<int>(std::lround(length_mm / finest_mm)), 2, kMostSlicePx);
  };
  vtkNew<vtkTexture> texture;
  texture->SetInputData(vtkImageOf(
      slicePicture(volume, whole, field, window, pixels(field.width_mm), pixels(field.height_mm))));
  texture->InterpolateOn();
  const Eigen::Vector3d right = field.width_mm * whole.right, up = field.height_mm * whole.up;
  const Eigen::Vector3d corner = whole.centre_mm - right / 2 - up / 2;
  const Eigen::Vector3d along = corner + right, above = corner + up;
  vtkNew<vtkPlaneSource> rectangle;
  rectangle->SetOrigin(corner.x(), corner.y(), corner.z());
  rectangle->SetPoint1(along.x(), along.y(), along.z());
  rectangle->SetPoint2(above.x(), above.y(), above.z());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(rectangle->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  actor->GetProperty()->LightingOff();
  return actor;
}

}  // namespace softscope
