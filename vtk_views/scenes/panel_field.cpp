// vtk_views/scenes/panel_field.cpp: projected boxes and their maximum.
#include "vtk_views/scenes/panel_field.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kStrays = 0.001;  // share of outliers at each end of an axis

/// Vertices of triangles; points without outliers.
void extend(const SceneSurface& surface, const ViewPlane& plane, Eigen::AlignedBox2d& box) {
  const auto& vertices = surface.mesh.vertices_mm;
  std::vector<char> drawn(vertices.size(), surface.isPoints() ? 1 : 0);
  for (const auto& triangle : surface.mesh.triangles)
    for (const std::int32_t vertex : triangle) drawn[static_cast<std::size_t>(vertex)] = 1;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (drawn[i] == 0 || !vertices[i].allFinite()) continue;
    const Eigen::Vector2d at = plane.project(vertices[i].cast<double>());
    x.push_back(at.x());
    y.push_back(at.y());
  }
  if (x.empty()) return;
  const std::size_t strays =
      surface.isPoints() ? static_cast<std::size_t>(kStrays * double(x.size())) : 0;
  const auto ends = [&](std::vector<double>& values) {
    const auto low = values.begin() + static_cast<std::ptrdiff_t>(strays);
    const auto high = values.end() - 1 - static_cast<std::ptrdiff_t>(strays);
    std::nth_element(values.begin(), low, values.end());
    const double first = *low;
    std::nth_element(values.begin(), high, values.end());
    return std::pair(first, *high);
  };
  const auto [left, right] = ends(x);
  const auto [down, up] = ends(y);
  box.extend(Eigen::Vector2d(left, down));
  box.extend(Eigen::Vector2d(right, up));
}

/// Relative to the centre of `plane`; box of the volume without surfaces.
Eigen::AlignedBox2d projectedBox(const FieldView& view, const ViewPlane& plane) {
  Eigen::AlignedBox2d box;
  for (const SceneSurface& surface : view.scene->surfaces)
    if (surface.in_3d || !view.is_3d) extend(surface, plane, box);
  if (!box.isEmpty() || !view.scene->volume) return box;
  const Eigen::AlignedBox3d volume = boxOf(*view.scene->volume);
  for (int i = 0; i < 8; ++i)
    box.extend(plane.project(volume.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))));
  return box;
}

/// Same world and direction.
bool haveSameView(const FieldView& a, const FieldView& b) {
  return a.world == b.world && a.plane.right.isApprox(b.plane.right) &&
         a.plane.up.isApprox(b.plane.up);
}

/// Uses the centre of the first view with the same direction, at the depth of this plane.
void shareCentre(const std::vector<FieldView>& views, const FieldView& view, ViewPlane& plane) {
  for (const FieldView& first : views) {
    if (!haveSameView(first, view)) continue;
    const Eigen::Vector3d axis = plane.towardsViewer();
    const double depth_mm = axis.dot(plane.centre_mm - first.plane.centre_mm);
    plane.centre_mm = first.plane.centre_mm + depth_mm * axis;
    return;
  }
}

}  // namespace

double sideRoomPt(const FigureStyle& style) { return 2.2 * style.font_pt; }

PanelField fitField(const std::vector<FieldView>& views, double panel_pt, const FigureStyle& style,
                    bool keep_centres) {
  PanelField field;
  double widest_mm = 0, volume_mm = 1e9;
  for (const FieldView& view : views) {
    ViewPlane plane = view.plane;
    if (!keep_centres) shareCentre(views, view, plane);
    Eigen::AlignedBox2d box;
    for (const FieldView& other : views)
      if (haveSameView(other, view)) box.extend(projectedBox(other, plane));
    if (keep_centres && !box.isEmpty()) {
      const Eigen::Vector2d reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
      widest_mm = std::max(widest_mm, 2 * reach.maxCoeff());
    } else if (!box.isEmpty()) {
      plane.centre_mm += box.center().x() * plane.right + box.center().y() * plane.up;
      widest_mm = std::max(widest_mm, box.sizes().maxCoeff());
    }
    if (view.scene->volume && !view.is_3d)
      volume_mm = std::min(volume_mm, boxOf(*view.scene->volume).sizes().maxCoeff());
    field.planes.push_back(std::move(plane));
  }
  if (!(widest_mm > 0)) throw Error("figure: there is nothing to show");
  const double inside = std::max(0.5, 1 - 2 * sideRoomPt(style) / panel_pt);
  field.width_mm = std::max(std::min(widest_mm / inside, volume_mm), 1e-3);
  return field;
}

}  // namespace softscope
