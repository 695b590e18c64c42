// vtk_views/surface_picture.cpp: one actor a surface, one renderer, pixels halved to smooth edges.
#include "vtk_views/surface_picture.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "vtk_views/offscreen_window.h"

namespace softscope {
namespace {

constexpr int kFiner = 2;  // pixels are drawn this much smaller each way, then averaged
constexpr int kSteps = 256;
constexpr double kNearer = 0.02;  // of the picture's width
constexpr Rgb8 kNeutral{205, 205, 205};
constexpr double kSeeThrough = 0.35;  // opacity

vtkSmartPointer<vtkPoints> pointsOf(const TriangleMesh& mesh) {
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(static_cast<vtkIdType>(mesh.vertices_mm.size()));
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    values->SetTypedTuple(static_cast<vtkIdType>(i), mesh.vertices_mm[i].data());
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(values);
  return points;
}

/// Mean of the triangles' normals by area: smooth shading.
vtkSmartPointer<vtkFloatArray> normalsOf(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> sums(mesh.vertices_mm.size(), Eigen::Vector3f::Zero());
  for (const Triangle& t : mesh.triangles) {
    const auto& a = mesh.vertices_mm[std::size_t(t[0])];
    const Eigen::Vector3f normal =
        (mesh.vertices_mm[std::size_t(t[1])] - a).cross(mesh.vertices_mm[std::size_t(t[2])] - a);
    for (const std::int32_t corner : t) sums[std::size_t(corner)] += normal;
  }
  auto normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(static_cast<vtkIdType>(sums.size()));
  for (std::size_t i = 0; i < sums.size(); ++i)
    normals->SetTypedTuple(static_cast<vtkIdType>(i), sums[i].normalized().eval().data());
  return normals;
}

vtkSmartPointer<vtkDoubleArray> scalarsOf(const std::vector<double>& errors_mm) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfTuples(static_cast<vtkIdType>(errors_mm.size()));
  std::copy(errors_mm.begin(), errors_mm.end(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> textureOf(const std::vector<Rgb8>& colours) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const unsigned char rgb[] = {colours[i].red, colours[i].green, colours[i].blue};
    array->SetTypedTuple(static_cast<vtkIdType>(i), rgb);
  }
  return array;
}

/// The bar's colours in steps too small to see.
vtkSmartPointer<vtkLookupTable> tableOf(const ErrorColours& colours) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  const auto set = [&](double value, auto&& put) {
    const Rgb8 c = colours.colour(value);
    put(c.red / 255.0, c.green / 255.0, c.blue / 255.0);
  };
  table->SetTableRange(colours.low_mm(), colours.limit_mm);
  table->SetNumberOfTableValues(kSteps);
  for (int i = 0; i < kSteps; ++i)
    set(colours.low_mm() + i / (kSteps - 1.0) * (colours.limit_mm - colours.low_mm()),
        [&](double r, double g, double b) { table->SetTableValue(i, r, g, b, 1); });
  set(std::nan(""), [&](double r, double g, double b) { table->SetNanColor(r, g, b, 1); });
  return table;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const SceneSurface& surface) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(surface.mesh));
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : surface.mesh.triangles) {
    const vtkIdType corners[] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  if (surface.isPoints()) {
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) cells->InsertNextCell(1, &i);
    data->SetVerts(cells);
  } else {
    data->SetPolys(cells);
    data->GetPointData()->SetNormals(normalsOf(surface.mesh));
  }
  if (!surface.errors_mm.empty())
    data->GetPointData()->SetScalars(scalarsOf(surface.errors_mm));
  else if (surface.mesh.colours.size() == surface.mesh.vertices_mm.size())
    data->GetPointData()->SetScalars(textureOf(surface.mesh.colours));
  return data;
}

/// How a surface is drawn beside the others.
struct Role {
  double point_size_px = 1;
  bool see_through = false;  // only the first one, and never beside errors
  bool neutral = false;      // grey: another surface has the colours of errors
  Eigen::Vector3d shift_mm = Eigen::Vector3d::Zero();
};

vtkSmartPointer<vtkActor> actorOf(const SceneSurface& surface, const ErrorColours& colours,
                                  const Role& role) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(polyDataOf(surface));
  if (!surface.errors_mm.empty()) {
    mapper->SetLookupTable(tableOf(colours));
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();  // between vertices errors are mixed, not colours
  }
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  const Rgb8 colour = role.neutral ? kNeutral : surface.colour;
  look->SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
  look->SetPointSize(float(role.point_size_px));
  actor->SetPosition(role.shift_mm.x(), role.shift_mm.y(), role.shift_mm.z());
  if (surface.isPoints() || !surface.errors_mm.empty()) {
    look->LightingOff();  // shading would change the colours that the bar promises
  } else {
    look->SetAmbient(0.3);
    look->SetDiffuse(0.8);
    look->SetSpecular(0.15);
    look->SetSpecularPower(20);
  }
  if (role.see_through) {
    look->SetOpacity(kSeeThrough);
    look->BackfaceCullingOn();  // one layer only: right without sorting
  }
  return actor;
}

void aim(vtkRenderer* renderer, const ViewPlane& camera, double height_mm, double depth_mm) {
  const Eigen::Vector3d eye = camera.centre_mm + depth_mm * camera.towardsViewer();
  vtkCamera* vtk = renderer->GetActiveCamera();
  vtk->ParallelProjectionOn();
  vtk->SetFocalPoint(camera.centre_mm.data());
  vtk->SetPosition(eye.data());
  vtk->SetViewUp(camera.up.data());
  vtk->SetParallelScale(height_mm / 2);
  renderer->ResetCameraClippingRange();
}

/// Means of kFiner x kFiner pixels; VTK's rows run upwards.
ColourImage readPixels(vtkRenderWindow* window, int width_px, int height_px) {
  vtkNew<vtkUnsignedCharArray> fine;
  window->GetPixelData(0, 0, kFiner * width_px - 1, kFiner * height_px - 1, 0, fine);
  const unsigned char* data = fine->GetPointer(0);
  ColourImage picture(width_px, height_px);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u) {
      int sum[3] = {0, 0, 0};
      for (int y = 0; y < kFiner; ++y)
        for (int x = 0; x < kFiner; ++x) {
          const std::size_t row =
              std::size_t(kFiner) * std::size_t(height_px - 1 - v) + std::size_t(y);
          const std::size_t at = row * std::size_t(kFiner * width_px) + std::size_t(kFiner * u + x);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += data[3 * at + c];
        }
      const auto mean = [&](int c) {
        return std::uint8_t((sum[c] + kFiner * kFiner / 2) / (kFiner * kFiner));
      };
      picture.at(u, v) = {mean(0), mean(1), mean(2)};
    }
  return picture;
}

}  // namespace

ColourImage drawSurfaces(const std::vector<SceneSurface>& surfaces, const ErrorColours& colours,
                         const ViewPlane& camera, const SurfacePictureOptions& options) {
  const double pixels_per_mm = kFiner * options.width_px / options.width_mm;
  const bool with_errors = std::any_of(surfaces.begin(), surfaces.end(),
                                       [](const auto& s) { return !s.errors_mm.empty(); });
  const Eigen::Vector3d shift_mm =
      std::max(kNearer * options.width_mm, with_errors ? 2 * colours.limit_mm : 0) *
      camera.towardsViewer();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SceneSurface& surface = surfaces[i];
    if (!surface.errors_mm.empty() && surface.errors_mm.size() != surface.mesh.vertices_mm.size())
      throw Error("error map: every vertex needs one error");
    Role role;
    role.point_size_px = std::max(1.0, options.point_size_mm * pixels_per_mm);
    role.see_through = options.see_through && i == 0 && surfaces.size() > 1 && !with_errors;
    role.neutral = with_errors && surface.errors_mm.empty();
    if (i > 0) role.shift_mm = shift_mm;
    renderer->AddActor(actorOf(surface, colours, role));
  }
  const auto window = makeOffscreenWindow(kFiner * options.width_px, kFiner * options.height_px);
  window->AddRenderer(renderer);
  const double height_mm = options.width_mm * options.height_px / options.width_px;
  aim(renderer, camera, height_mm, 4 * std::max(options.width_mm, height_mm));
  window->Render();
  return readPixels(window, options.width_px, options.height_px);
}

}  // namespace softscope
