// vtk_views/viewer/view_props.h: what a viewer draws beside surfaces: scope, path, nodes, arrows,
// slices.
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

/// Lines of one colour, unlit: each pair of points is one, mm. `width_px` on screen.
struct LineSet {
  std::vector<std::pair<Eigen::Vector3f, Eigen::Vector3f>> lines_mm;
  Rgb8 colour;
  double width_px = 1.5;
};
vtkSmartPointer<vtkActor> lineActor(const LineSet& lines);
void redressLines(const LineSet& lines, vtkActor* actor);

/// The pyramid that the scope looks into, as deep as `depth_mm`, with a mark at its upper side.
LineSet scopeLines(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left,
                   double depth_mm);

/// From point to point.
LineSet pathLines(const std::vector<Eigen::Vector3f>& points_mm, Rgb8 colour);

/// A shaft and two barbs each, drawn `times` as long as the motion that leads to each point;
/// motions below `least_mm` are left out.
LineSet motionArrows(const std::vector<Eigen::Vector3f>& ends_mm,
                     const std::vector<Eigen::Vector3f>& motions_mm, double times, double least_mm,
                     Rgb8 colour);

/// The volume's slice by that plane as an image in space: a square of `side_mm` around the plane's
/// centre, or less where the volume ends.
vtkSmartPointer<vtkActor> sliceActor(const Volume& volume, const ViewPlane& plane,
                                     const GreyWindow& window, double side_mm);

}  // namespace softscope
