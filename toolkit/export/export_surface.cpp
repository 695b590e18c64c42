// toolkit/export/export_surface.cpp: calls src/mesh, and reports the result.
#include "toolkit/export/export_surface.h"

#include "core/error.h"
#include "io/text/message.h"
#include "mesh/mesh_check.h"
#include "vtk_views/drawing/html_text.h"

namespace softscope {
namespace {

std::string droppedText(const PointSurface& surface) {
  return say(surface.dropped_islands, " islands and lone points: ", surface.dropped_points,
             " points");
}

}  // namespace

ModelSurface makeSurface(const ModelSurface& points, const SurfaceOptions& options,
                         const std::string& name, FactSheet& facts) {
  PointSurface made;
  try {
    made = surfaceFromPoints(points.vertices, options);
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
  facts.add("points", "points", int(points.vertices.points_mm.size()));
  facts.add("gaps closed",
            say("up to ", fixed(made.gap_mm, 2), " mm; the points' spacing is ",
                fixed(made.spacing_mm, 2), " mm"),
            "gap_mm", made.gap_mm);
  facts.addQuietly("spacing_mm", made.spacing_mm);
  facts.add("dropped", droppedText(made), "dropped_islands", made.dropped_islands);
  facts.addQuietly("dropped_points", made.dropped_points);
  facts.addQuietly("crowded_points", made.crowded_points);
  facts.addQuietly("invalid_points", made.invalid_points);
  if (made.invalid_points > 0)
    facts.warn(say(made.invalid_points, " points are not finite or have no normal; left out"));
  ModelSurface surface;
  surface.space = points.space;
  surface.frame = points.frame;
  surface.triangles = std::move(made.mesh.triangles);
  surface.vertices.points_mm = std::move(made.mesh.vertices_mm);
  surface.vertices.colours = std::move(made.mesh.colours);
  surface.vertices.normals = std::move(made.normals);
  if (!points.vertices.weights.empty())
    for (const std::int32_t point : made.points)
      surface.vertices.weights.push_back(points.vertices.weights[std::size_t(point)]);
  if (!points.vertices.sigmas_mm.empty())
    for (const std::int32_t point : made.points)
      surface.vertices.sigmas_mm.push_back(points.vertices.sigmas_mm[std::size_t(point)]);
  return surface;
}

void addModelFacts(const ModelSurface& model, FactSheet& facts) {
  facts.add("vertices", "vertices", int(model.vertices.points_mm.size()));
  facts.add("triangles", "triangles", int(model.triangles.size()));
  if (!model.triangles.empty()) {
    const MeshCheck check = checkMesh({model.vertices.points_mm, model.triangles, {}, {}});
    facts.add("area", fixed(check.area_mm2 / 100, 2) + " cm²", "area_mm2", check.area_mm2);
    facts.add("pieces", "pieces", int(check.components));
    facts.addQuietly("manifold", check.manifold());
  }
  facts.addQuietly("space", model.space);
  if (!model.frame.empty())
    facts.add("lies in", "the scope's frame \"" + model.frame + "\"", "frame", model.frame);
  else
    facts.addLine("space", model.space.empty() ? "not said" : model.space);
}

std::string pvdLine(double time_s, const std::filesystem::path& file) {
  return say("<DataSet timestep=\"", time_s, "\" file=\"", htmlEscaped(file.string()), "\"/>\n");
}

std::string pvdFile(const std::string& lines) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<Collection>\n" +
         lines + "</Collection>\n</VTKFile>\n";
}

}  // namespace softscope
