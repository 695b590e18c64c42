// vtk_views/viewer/view_scene.h: a moment of a run as a 3-D scene.
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

/// Surfaces, points and their colours are those of figures (surface_actor.h). The window's owner
/// adds renderer() to it.
class ViewScene {
 public:
  /// The world must outlive it.
  explicit ViewScene(const ViewWorld& world);

  vtkRenderer* renderer() { return renderer_; }
  /// Puts a moment there. The camera stays, but the scope's own eye follows the scope.
  void show(const ViewMoment& moment, const ViewState& state);
  /// Takes the state's look at what is shown, so that it fills the window and nothing is cut.
  /// `aspect`: of the renderer, width / height.
  void look(const ViewMoment& moment, const ViewState& state, double aspect);
  /// Turns about what is looked at, from where it was looked at.
  void turn(double angle_deg);
  /// Gives lines and the dots of nodes their size.
  void sizeFor(double line_scale);
  /// What an image of that width shows, mm; NaN where near is larger than far.
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
  Eigen::AlignedBox2d boxSeen(const ViewMoment& moment, const ViewPlane& plane, bool turning) const;
  void measure(const ViewMoment& moment);

  const ViewWorld& world_;
  vtkNew<vtkRenderer> renderer_;
  vtkSmartPointer<vtkActor> points_, reference_, scope_, path_, nodes_, arrows_;
  std::vector<vtkSmartPointer<vtkActor>> slices_;
  Look slices_look_ = Look::kFree;
  std::shared_ptr<const TriangleMesh> reference_shown_;
  Eigen::Vector3d centre_mm_ = Eigen::Vector3d::Zero();
  double width_mm_ = 0;  // 0: not measured yet
  double aspect_ = 1;
};

}  // namespace softscope
