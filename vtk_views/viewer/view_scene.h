// vtk_views/viewer/view_scene.h: 3-D scene of a model of a run.
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "vtk_views/viewer/view_controls.h"
#include "vtk_views/viewer/view_props.h"
#include "vtk_views/viewer/view_source.h"

namespace softscope {

/// Surfaces, points and colours as in figures (surface_actor.h).
/// The owner of the window adds renderer() to it.
class ViewScene {
 public:
  /// The world must outlive it.
  explicit ViewScene(const ViewWorld& world);

  vtkRenderer* renderer() { return renderer_; }
  /// Shows a model. The camera is kept, except that the scope view follows the scope.
  void show(const ViewMoment& moment, const ViewState& state);
  /// Applies the viewpoint of the state, such that the content fills the
  /// window without cuts. `aspect`: of the renderer, width / height.
  void look(const ViewMoment& moment, const ViewState& state, double aspect);
  /// Rotates about the focal point.
  void turn(double angle_deg);
  /// Sets the size of lines and node dots.
  void sizeFor(double line_scale);
  /// Field of view, mm; NaN in perspective projection.
  double widthShownMm(double aspect) const;

 private:
  void addActor(vtkActor* actor) { renderer_->AddActor(actor); }
  SceneSurface shownPoints(const ViewMoment& moment, const ViewState& state);
  void showPoints(const ViewMoment& moment, const ViewState& state);
  void showReference(const ViewMoment& moment, const ViewState& state);
  void showScope(const ViewMoment& moment, const ViewState& state);
  void showNodes(const ViewMoment& moment, const ViewState& state);
  void showSlices(const ViewMoment& moment, const ViewState& state);
  void addSlices(const Eigen::Vector3d& towards_viewer);
  ViewPlane viewFor(Look look) const;
  LineSet scopeOf(const ViewMoment& moment) const;
  Eigen::AlignedBox2d visibleBox(const ViewMoment& moment, const ViewPlane& plane,
                                 bool turning) const;
  void measure(const ViewMoment& moment);

  const ViewWorld& world_;
  vtkNew<vtkRenderer> renderer_;
  vtkSmartPointer<vtkActor> points_, reference_, scope_, path_, nodes_, arrows_;
  std::vector<vtkSmartPointer<vtkActor>> slices_;
  Look slices_look_ = Look::kFree;
  std::shared_ptr<const TriangleMesh> reference_shown_;
  Eigen::Vector3d centre_mm_ = Eigen::Vector3d::Zero();
  double width_mm_ = 0;  // 0: not computed yet
  double aspect_ = 1;
};

}  // namespace softscope
