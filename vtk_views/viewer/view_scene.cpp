// vtk_views/viewer/view_scene.cpp: one actor per element, updated for every model.
#include "vtk_views/viewer/view_scene.h"

#include <vtkCamera.h>
#include <vtkMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vtk_views/scenes/four_panels.h"
#include "vtk_views/scenes/point_splats.h"
#include "vtk_views/scenes/surface_actor.h"
#include "vtk_views/scenes/view_camera.h"
#include "vtk_views/viewer/view_props.h"

namespace softscope {
namespace {

constexpr double kScopeDepth = 0.22;    // as a share of the distance to the tissue
constexpr double kSceneEyeAway = 4;     // in image widths
constexpr double kSceneRoom = 1.08;     // margin of the field of view
constexpr double kSceneStrays = 0.002;  // share of points that may be cut at each side
constexpr double kStraysFrom = 0.1;     // distance of outliers, in units of the width of the others
constexpr double kArrowTimes = 4, kLeastMotion_mm = 0.05;
constexpr double kNodeDotsPx = 5;
constexpr double kSliceBehind = 0.7;   // slices behind the centre, in widths of the model
constexpr double kNearerSteps = -600;  // of the depth buffer (65 536)
constexpr Rgb8 kNodeColour{20, 60, 200}, kArrowColour{235, 30, 35}, kReferenceColour{175, 175, 175};
constexpr Rgb8 kPathColour{0, 110, 170};
const Eigen::Vector3d kFromTheScope(0.55, -0.45, -0.8);

SceneSurface surfaceOf(TriangleMesh mesh, Rgb8 colour) {
  SceneSurface surface;
  surface.mesh = std::move(mesh);
  surface.colour = colour;
  return surface;
}

/// Extreme values without distant outliers.
std::pair<double, double> endsOfMost(std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double least = *low, most = *high;
  const auto strays = static_cast<std::ptrdiff_t>(kSceneStrays * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + strays, values.end());
  const double first = values[std::size_t(strays)];
  std::nth_element(values.begin(), values.end() - 1 - strays, values.end());
  const double last = *(values.end() - 1 - strays), far = kStraysFrom * (last - first);
  return {least < first - far ? first : least, most > last + far ? last : most};
}

/// Depth offset towards the eye: nodes are in the surface, not behind its dots.
void drawOver(vtkActor* actor) {
  vtkMapper* mapper = actor->GetMapper();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(kNearerSteps);
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0, kNearerSteps);
}

/// Depth offset away from the eye: transparent surfaces must not tint error colours.
void drawUnder(vtkActor* actor) {
  vtkMapper* mapper = actor->GetMapper();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0, -kNearerSteps);
}

LineSet arrowsOf(const ViewMoment& moment) {
  return motionArrows(moment.nodes_mm, moment.node_motion_mm, kArrowTimes, kLeastMotion_mm,
                      kArrowColour);
}

}  // namespace

ViewScene::ViewScene(const ViewWorld& world) : world_(world) {
  renderer_->SetBackground(1, 1, 1);  // as paper has it
}

SceneSurface ViewScene::shownPoints(const ViewMoment& moment, const ViewState& state) {
  SceneSurface surface;
  if (state.colour == ViewColour::kErrors && !moment.errors_mm.empty()) {
    surface = surfaceOf(moment.judged, surfaceColour(0));
    surface.errors_mm = moment.errors_mm;
    return surface;
  }
  surface = surfaceOf(moment.model, kReferenceColour);
  if (state.colour == ViewColour::kWeights && !moment.weights.empty()) {
    surface.errors_mm.assign(moment.weights.begin(), moment.weights.end());
  } else if (state.colour != ViewColour::kTexture) {
    surface.mesh.colours.clear();  // unknown: grey
  }
  return surface;
}

void ViewScene::showPoints(const ViewMoment& moment, const ViewState& state) {
  Eigen::Vector3d eye_mm = centre_mm_ - kSceneEyeAway * width_mm_ * Eigen::Vector3d::UnitZ();
  if (moment.world_from_left) eye_mm = moment.world_from_left->translation();
  const SceneSurface surface =
      splatsOf(shownPoints(moment, state), state.dot_scale, eye_mm.cast<float>());
  ErrorColours colours = world_.errors;
  if (state.colour == ViewColour::kWeights) colours = {false, world_.largest_weight};
  SurfaceRole role;
  role.unlit = true;
  if (points_) return redressSurface(surface, colours, role, points_);
  points_ = surfaceActor(surface, colours, role);
  addActor(points_);
}

void ViewScene::showReference(const ViewMoment& moment, const ViewState& state) {
  if (moment.reference && moment.reference != reference_shown_) {
    const SceneSurface surface = surfaceOf(*moment.reference, kReferenceColour);
    SurfaceRole role;
    role.see_through = true;
    if (reference_) {
      redressSurface(surface, world_.errors, role, reference_);
    } else {
      reference_ = surfaceActor(surface, world_.errors, role);
      addActor(reference_);
      drawUnder(reference_);
    }
    reference_shown_ = moment.reference;
  }
  if (reference_) reference_->SetVisibility(state.reference && moment.reference != nullptr);
}

LineSet ViewScene::scopeOf(const ViewMoment& moment) const {
  if (!moment.world_from_left || world_.left.width_px <= 0) return {};
  const Eigen::Vector3d eye = moment.world_from_left->translation();
  return scopeLines(world_.left, *moment.world_from_left, kScopeDepth * (centre_mm_ - eye).norm());
}

void ViewScene::showScope(const ViewMoment& moment, const ViewState& state) {
  const bool shown = state.scope && state.look != Look::kScope && moment.world_from_left;
  std::vector<Eigen::Vector3f> path;
  for (const auto& [frame, place] : world_.path_mm)
    if (frame <= moment.frame) path.push_back(place);
  const LineSet way = pathLines(path, kPathColour);
  const LineSet scope = scopeOf(moment);
  if (scope_) {
    redressLines(scope, scope_);
    redressLines(way, path_);
  } else {
    addActor(scope_ = lineActor(scope));
    addActor(path_ = lineActor(way));
  }
  scope_->SetVisibility(shown);
  path_->SetVisibility(shown);
}

void ViewScene::showNodes(const ViewMoment& moment, const ViewState& state) {
  TriangleMesh mesh;
  mesh.vertices_mm = moment.nodes_mm;
  const SceneSurface nodes = surfaceOf(mesh, kNodeColour);
  SurfaceRole role;
  role.point_size_px = nodes_ ? nodes_->GetProperty()->GetPointSize() : kNodeDotsPx;
  const LineSet arrows = arrowsOf(moment);
  if (nodes_) {
    redressSurface(nodes, world_.errors, role, nodes_);
    redressLines(arrows, arrows_);
  } else {
    addActor(nodes_ = surfaceActor(nodes, world_.errors, role));
    addActor(arrows_ = lineActor(arrows));
    drawOver(nodes_);
    drawOver(arrows_);
  }
  nodes_->SetVisibility(state.nodes);
  arrows_->SetVisibility(state.motion);
}

/// Corner of three slices behind the model in this view.
void ViewScene::addSlices(const Eigen::Vector3d& towards_viewer) {
  for (const auto& slice : slices_) renderer_->RemoveActor(slice);
  slices_.clear();
  const auto box = boxOf(*world_.volume);
  Eigen::Vector3d at = centre_mm_;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] -= (towards_viewer[axis] < 0 ? -kSliceBehind : kSliceBehind) * width_mm_;
  at = at.cwiseMax(box.min()).cwiseMin(box.max());
  const SideRule rule = SideRule::kRadiological;
  for (ViewPlane plane : {axialView(at, world_.frame, rule), coronalView(at, world_.frame, rule),
                          sagittalView(at, world_.frame)}) {
    const Eigen::Vector3d sideways = centre_mm_ - at;
    plane.centre_mm += sideways.dot(plane.right) * plane.right + sideways.dot(plane.up) * plane.up;
    slices_.push_back(
        sliceActor(*world_.volume, plane, world_.window, 2 * kSliceBehind * width_mm_));
    addActor(slices_.back());
  }
}

void ViewScene::showSlices(const ViewMoment& moment, const ViewState& state) {
  if (!world_.volume) return;
  if (state.ct && (slices_.empty() || state.look != slices_look_)) {
    Eigen::Vector3d towards_viewer = viewFor(state.look).towardsViewer();
    if (state.look == Look::kScope && moment.world_from_left)
      towards_viewer = -moment.world_from_left->linear().col(2);
    addSlices(towards_viewer);
    slices_look_ = state.look;
  }
  for (const auto& slice : slices_) slice->SetVisibility(state.ct);
}

void ViewScene::measure(const ViewMoment& moment) {
  SceneSurface model = surfaceOf(moment.model, kReferenceColour);
  model.in_focus = true;
  Scene scene;
  scene.surfaces.push_back(std::move(model));
  centre_mm_ = sceneCentre(scene);
  width_mm_ = sceneWidthMm(scene);
}

void ViewScene::show(const ViewMoment& moment, const ViewState& state) {
  if (width_mm_ == 0) measure(moment);
  showPoints(moment, state);
  showReference(moment, state);
  showScope(moment, state);
  showNodes(moment, state);
  showSlices(moment, state);
  if (state.look == Look::kScope) look(moment, state, aspect_);
  renderer_->ResetCameraClippingRange();
}

ViewPlane ViewScene::viewFor(Look look) const {
  const bool of_scope = world_.frame == SceneFrame::kCamera;
  const FourPanelOptions figure;
  if (look == Look::kFront) return axialView(centre_mm_, world_.frame, figure.rule);
  if (look == Look::kAbove) return coronalView(centre_mm_, world_.frame, figure.rule);
  if (look == Look::kRight) return sagittalView(centre_mm_, world_.frame);
  return cameraView(centre_mm_, of_scope ? kFromTheScope : figure.eye, world_.frame);
}

/// Visible extent in the plane of the view, relative to its centre: the
/// model without distant outliers; for a rotation, the full swept extent.
Eigen::AlignedBox2d ViewScene::visibleBox(const ViewMoment& moment, const ViewPlane& plane,
                                          bool turning) const {
  const auto place = [&](const Eigen::Vector3f& point_mm) {
    Eigen::Vector2d at = plane.project(point_mm.cast<double>());
    const double depth_mm = plane.towardsViewer().dot(point_mm.cast<double>() - plane.centre_mm);
    if (turning) at.x() = std::hypot(at.x(), depth_mm);
    return at;
  };
  Eigen::AlignedBox2d box;
  std::array<std::vector<double>, 2> along;
  for (const Eigen::Vector3f& point_mm : moment.model.vertices_mm) {
    const Eigen::Vector2d at = place(point_mm);
    along[0].push_back(at.x());
    along[1].push_back(at.y());
  }
  if (!along[0].empty()) {
    const auto [left, right] = endsOfMost(along[0]);
    const auto [down, up] = endsOfMost(along[1]);
    box.extend(Eigen::Vector2d(left, down)).extend(Eigen::Vector2d(right, up));
  }
  const auto extendBy = [&](const vtkSmartPointer<vtkActor>& actor, const LineSet& lines) {
    if (!actor || !actor->GetVisibility()) return;
    for (const auto& [begin, end] : lines.lines_mm) box.extend(place(begin)).extend(place(end));
  };
  extendBy(arrows_, arrowsOf(moment));
  extendBy(scope_, scopeOf(moment));
  if (reference_ && reference_->GetVisibility())
    for (const Eigen::Vector3f& point_mm : reference_shown_->vertices_mm)
      box.extend(place(point_mm));
  if (turning && !box.isEmpty()) box.extend(Eigen::Vector2d(-box.max().x(), box.center().y()));
  return box;
}

void ViewScene::look(const ViewMoment& moment, const ViewState& state, double aspect) {
  const Look look = state.look;
  aspect_ = aspect;
  measure(moment);
  if (look == Look::kScope && moment.world_from_left && world_.left.width_px > 0) {
    const double focus_mm = (moment.world_from_left->inverse() * centre_mm_).z();
    return aimAsScope(renderer_, world_.left, *moment.world_from_left, std::max(focus_mm, 1.0),
                      aspect);
  }
  ViewPlane plane = viewFor(look);
  const Eigen::AlignedBox2d box = visibleBox(moment, plane, state.turning);
  double height_mm = aspect > 1 ? width_mm_ : width_mm_ / aspect;
  if (!box.isEmpty() && box.sizes().maxCoeff() > 0) {
    height_mm = kSceneRoom * std::max(box.sizes().y(), box.sizes().x() / aspect);
    const Eigen::Vector2d middle = box.center();
    plane.centre_mm += middle.x() * plane.right + middle.y() * plane.up;
  }
  aimParallel(renderer_, plane, height_mm, kSceneEyeAway * std::max(width_mm_, height_mm));
}

void ViewScene::turn(double angle_deg) {
  renderer_->GetActiveCamera()->Azimuth(angle_deg);
  renderer_->ResetCameraClippingRange();
}

void ViewScene::sizeFor(double line_scale) {
  if (nodes_) nodes_->GetProperty()->SetPointSize(float(kNodeDotsPx * line_scale));
  for (const auto& lines : {scope_, path_, arrows_})
    if (lines) lines->GetProperty()->SetLineWidth(float(1.6 * line_scale));
}

double ViewScene::widthShownMm(double aspect) const {
  vtkCamera* camera = const_cast<vtkRenderer*>(renderer_.Get())->GetActiveCamera();
  if (camera->GetParallelProjection() == 0) return std::nan("");
  return 2 * camera->GetParallelScale() * aspect;
}

}  // namespace softscope
