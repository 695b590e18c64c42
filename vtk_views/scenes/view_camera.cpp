// vtk_views/scenes/view_camera.cpp: positions, angles and scales.
#include "vtk_views/scenes/view_camera.h"

#include <vtkCamera.h>

#include <algorithm>
#include <cmath>

namespace softscope {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

double tangentOfHalf(double angle_deg) { return std::tan(angle_deg / 2 / kDegrees); }

}  // namespace

void aimParallel(vtkRenderer* renderer, const ViewPlane& view, double height_mm, double depth_mm) {
  const Eigen::Vector3d eye = view.centre_mm + depth_mm * view.towardsViewer();
  vtkCamera* vtk = renderer->GetActiveCamera();
  vtk->ParallelProjectionOn();
  vtk->SetWindowCenter(0, 0);
  vtk->SetFocalPoint(view.centre_mm.data());
  vtk->SetPosition(eye.data());
  vtk->SetViewUp(view.up.data());
  vtk->SetParallelScale(height_mm / 2);
  renderer->ResetCameraClippingRange();
}

void aimAsScope(vtkRenderer* renderer, const PinholeCamera& left,
                const Eigen::Isometry3d& world_from_left, double focus_mm, double aspect) {
  const double half_height = 0.5 * left.height_px / left.fy_px;
  const double half_width = 0.5 * left.width_px / left.fx_px;
  const double half = std::max(half_height, half_width / aspect);  // in units of the image height
  const Eigen::Vector3d eye = world_from_left.translation();
  const Eigen::Vector3d focus = world_from_left * Eigen::Vector3d(0, 0, focus_mm);
  const Eigen::Vector3d up = -world_from_left.linear().col(1);
  vtkCamera* vtk = renderer->GetActiveCamera();
  vtk->ParallelProjectionOff();
  vtk->SetPosition(eye.data());
  vtk->SetFocalPoint(focus.data());
  vtk->SetViewUp(up.data());
  vtk->SetViewAngle(2 * std::atan(half) * kDegrees);
  // The principal point differs from the image centre; in shares of half of the image.
  vtk->SetWindowCenter((0.5 * (left.width_px - 1) - left.cx_px) / left.fx_px / (half * aspect),
                       (left.cy_px - 0.5 * (left.height_px - 1)) / left.fy_px / half);
  renderer->ResetCameraClippingRange();
}

void makeParallel(vtkRenderer* renderer) {
  vtkCamera* vtk = renderer->GetActiveCamera();
  if (vtk->GetParallelProjection() != 0) return;
  vtk->SetParallelScale(vtk->GetDistance() * tangentOfHalf(vtk->GetViewAngle()));
  vtk->SetWindowCenter(0, 0);
  vtk->ParallelProjectionOn();
}

}  // namespace softscope
