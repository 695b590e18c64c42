// vtk_views/viewer/view_props.h: actors of the
// viewer: scope, path, nodes, arrows, slices.
#pragma once

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "vtk_views/scenes/view_plane.h"
#include "vtk_views/volumes/grey_window.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {

/// Unlit lines of one colour, one per pair of points, mm. `width_px` on screen.
struct LineSet {
  std::vector<std::pair<Eigen::Vector3f, Eigen::Vector3f>> lines_mm;
  Rgb8 colour;
  double width_px = 1.5;
};
vtkSmartPointer<vtkActor> lineActor(const LineSet& lines);
void redressLines(const LineSet& lines, vtkActor* actor);

/// Frustum of the scope with depth `depth_mm`, and a mark at its upper side.
LineSet scopeLines(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left,
                   double depth_mm);

/// Polyline.
LineSet pathLines(const std::vector<Eigen::Vector3f>& points_mm, Rgb8 colour);

/// Arrows with `times` the length of the motion that ends
/// at each point; motions below `least_mm` are omitted.
LineSet motionArrows(const std::vector<Eigen::Vector3f>& ends_mm,
                     const std::vector<Eigen::Vector3f>& motions_mm, double times, double least_mm,
                     Rgb8 colour);

/// Slice of the volume as an image in space: a square of
/// `side_mm` around the centre of the plane, cut at the volume.
vtkSmartPointer<vtkActor> sliceActor(const Volume& volume, const ViewPlane& plane,
                                     const GreyWindow& window, double side_mm);

}  // namespace softscope
