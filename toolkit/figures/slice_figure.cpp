// toolkit/figures/slice_figure.cpp: planes with their positions, scene and record.
#include "toolkit/figures/slice_figure.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/error.h"
#include "core/parallel.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/figures/figure_outputs.h"
#include "toolkit/figures/scene_inputs.h"
#include "vtk_views/scenes/four_panels.h"

namespace softscope {
namespace {

constexpr std::size_t kMostSlices = 100;

/// "10,20,30" or "10:30:10". Throws OptionError.
std::vector<double> parsePositions(std::string text) {
  const std::string given = text;
  const bool range = text.find(':') != std::string::npos;
  for (char& c : text)
    if (c == ':') c = ' ';
  std::vector<double> values;
  for (const std::string_view word : wordsOf(text)) {
    const auto value = numberOf(word);
    if (!value || !std::isfinite(*value)) {
      values.clear();
      break;
    }
    values.push_back(*value);
  }
  if (range && values.size() == 3 && values[2] != 0 && (values[1] - values[0]) / values[2] >= 0 &&
      (values[1] - values[0]) / values[2] < double(kMostSlices)) {
    const double first = values[0], step = values[2];
    const auto count = static_cast<int>((values[1] - first) / step + 1e-6) + 1;
    values.clear();
    for (int i = 0; i < count; ++i) values.push_back(first + i * step);
  } else if (range) {
    values.clear();
  }
  if (values.empty() || values.size() > kMostSlices)
    throw OptionError("`positions=` is `" + given +
                      "`, but must be 1 to 100 places in mm: 10,20,30, or FIRST:LAST:STEP");
  return values;
}

void readScene(const SliceRequest& request, SceneInputs& inputs) {
  if (!request.ct.empty())
    inputs.addVolume(request.ct, request.page.window, request.page.volume.options());
  std::size_t colour = 0;
  if (!request.reference.empty())
    inputs.addSurface(request.reference, "reference", "reference", surfaceColour(colour++));
  for (const std::string& path : request.surfaces)
    inputs.addSurface(path, "surface", shown(std::filesystem::path(path).filename()),
                      surfaceColour(colour++));
  for (const std::string& path : request.scans)
    inputs.addSurface(path, "scan", "scan", kScanRed).mesh.triangles.clear();
  inputs.checkPlaces();
}

ViewPlane planeNamed(const SliceRequest& request, const std::string& name,
                     const Eigen::Vector3d& centre_mm) {
  const SideRule rule = request.page.sideRule();
  if (name == "axial") return axialView(centre_mm, SceneFrame::kPatient, rule);
  if (name == "coronal") return coronalView(centre_mm, SceneFrame::kPatient, rule);
  if (name == "sagittal") return sagittalView(centre_mm, SceneFrame::kPatient);
  if (name != "oblique")
    throw OptionError("`planes=` is `" + name +
                      "`, but must be axial, coronal, sagittal or oblique");
  if (request.normal.empty()) throw OptionError("`planes=` oblique needs `normal=` X,Y,Z");
  return obliqueView(centre_mm, parseVector(request.normal, "`normal=`"), SceneFrame::kPatient,
                     rule);
}

Eigen::Vector3d centreOf(const SliceRequest& request, const Scene& scene) {
  return request.page.centreIn(scene, request.surfaces.empty()
                                          ? nullptr
                                          : &scene.surfaces[(request.reference.empty() ? 0 : 1)]);
}

/// Positions of oblique planes, which do not fit into the captions. Empty without oblique planes.
std::vector<std::string> notesOnPlanes(const SliceRequest& request,
                                       const Eigen::Vector3d& centre_mm, SceneFrame frame) {
  if (std::count(request.planes.begin(), request.planes.end(), "oblique") == 0) return {};
  const Eigen::Vector3d normal = parseVector(request.normal, "`normal=`").normalized();
  return {(request.positions.empty() ? "Oblique plane through " : "Oblique planes, 0 mm at ") +
          sidesText(centre_mm, 1, frame) + " mm; normal " + sidesText(normal, 2, frame)};
}

std::vector<ViewPlane> planesThrough(const SliceRequest& request,
                                     const Eigen::Vector3d& centre_mm) {
  std::vector<std::string> names = request.planes;
  if (names.empty()) names = {"axial", "coronal", "sagittal"};
  std::vector<ViewPlane> planes;
  for (const std::string& name : names) planes.push_back(planeNamed(request, name, centre_mm));
  if (request.positions.empty()) return planes;
  const ViewPlane plane = planes[0];
  Eigen::Vector3d axis = plane.towardsViewer().cwiseAbs();  // of a standard plane: x, y or z
  if (plane.name == "oblique") axis = parseVector(request.normal, "`normal=`").normalized();
  planes.clear();
  for (const double place_mm : parsePositions(request.positions)) {
    ViewPlane moved = plane;
    const double from_mm = plane.name == "oblique" ? 0 : axis.dot(plane.centre_mm);
    moved.centre_mm += (place_mm - from_mm) * axis;
    if (plane.name == "oblique") {
      char text[48];
      std::snprintf(text, sizeof text, "oblique, %+.1f mm", place_mm);
      moved.name = text;
    }
    planes.push_back(moved);
  }
  return planes;
}

/// True if the field of view shows nothing of the box.
bool misses(const ViewPlane& plane, double width_mm, const Eigen::AlignedBox3d& box_mm) {
  Eigen::AlignedBox3d around;  // the box in right, up and depth from the centre
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at = box_mm.corner(Eigen::AlignedBox3d::CornerType(corner));
    const Eigen::Vector2d place = plane.project(at);
    around.extend(
        Eigen::Vector3d(place.x(), place.y(), plane.towardsViewer().dot(at - plane.centre_mm)));
  }
  const Eigen::Vector3d reach(width_mm, width_mm, 0);  // twice the half, as panels aren't square
  return !around.intersects(Eigen::AlignedBox3d(-reach, reach));
}

std::string rangesText(const Eigen::AlignedBox3d& box_mm) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis > 0 ? std::string(", ") : std::string()) + "xyz"[axis] + " " +
            fixed(box_mm.min()[axis], 1) + " to " + fixed(box_mm.max()[axis], 1);
  return text + " mm";
}

/// Warnings of requested planes outside of the volume, or without one of the surfaces.
/// Throws OptionError if all of them show nothing.
std::vector<std::string> checkPlanes(const SliceRequest& request, const Scene& scene,
                                     const PanelField& field) {
  if (request.positions.empty() && request.page.at.empty()) return {};
  const bool in_volume = scene.volume.has_value();
  const Eigen::AlignedBox3d surfaces = boxOf(scene.surfaces);
  const Eigen::AlignedBox3d content = in_volume ? boxOf(*scene.volume) : surfaces;
  const std::string where =
      std::string(in_volume ? "the volume" : "the surfaces") + ", " + rangesText(content);
  std::vector<std::string> warnings;
  bool any = false;
  for (const ViewPlane& plane : field.planes) {
    const bool outside = misses(plane, field.width_mm, content);
    any |= !outside || (!surfaces.isEmpty() && !misses(plane, field.width_mm, surfaces));
    if (outside)
      warnings.push_back(plane.name + " plane at " + sidesText(plane.centre_mm, 1, scene.frame) +
                         " mm: is outside of " + where);
  }
  if (any) return warnings;
  const bool by_position = !request.positions.empty();
  throw OptionError(std::string(by_position ? "`positions=`" : "`at=`") + " is `" +
                    (by_position ? request.positions : request.page.at) +
                    "`, but every plane there is outside of " + where);
}

}  // namespace

void SliceRequest::validate() const {
  page.validate();
  require(columns >= 0, "`columns=`", columns, "must be 1 or more");
  if (ct.empty() && reference.empty() && surfaces.empty() && scans.empty())
    throw OptionError("there is nothing to slice; give a VOLUME, `reference=` or `surfaces=`");
  if (!positions.empty() && planes.size() != 1)
    throw OptionError("`positions=` is for one plane; give one by `planes=`");
  if (!positions.empty()) parsePositions(positions);
  for (const std::string& name : planes) planeNamed(*this, name, Eigen::Vector3d::Zero());
}

DrawnFigure drawSliceFigure(const SliceRequest& request) {
  request.validate();
  SceneInputs inputs(request.page.unit_mm);
  readScene(request, inputs);
  Scene& scene = inputs.scene();
  scene.dot_reach_mm = request.page.dot_reach_mm;
  PanelOptions panels;
  panels.style = request.page.figureStyle();
  panels.width_mm = request.page.field_mm;
  panels.keep_centres = !request.page.at.empty();
  panels.columns = request.columns;
  const Eigen::Vector3d centre_mm = centreOf(request, scene);
  const std::vector<ViewPlane> planes = planesThrough(request, centre_mm);
  panels.foot.notes = notesOnPlanes(request, centre_mm, scene.frame);
  const PanelField field = sliceViews(scene, planes, panels);
  DrawnFigure figure;
  figure.warnings = inputs.warnings();
  for (const std::string& warning : checkPlanes(request, scene, field))
    figure.warnings.push_back(warning);
  FactSheet::Json& record = figure.record = figureRecord("slice", request.page);
  parallelInvoke([&] { record["inputs"] = inputs.inputsJson(); },
                 [&] { figure.drawing = drawSlices(scene, planes, panels); });
  record["volume"] = inputs.volumeJson();
  record["surfaces"] = inputs.surfacesJson();
  for (const ViewPlane& plane : field.planes)
    record["views"].push_back(viewJson(plane, scene.frame, field.width_mm));
  record["warnings"] = figure.warnings;
  record = request.page.paths.applyTo(record);
  return figure;
}

}  // namespace softscope
