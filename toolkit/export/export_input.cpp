// toolkit/export/export_input.cpp: runs, models and meshes.
#include "toolkit/export/export_input.h"

#include <algorithm>
#include <string_view>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "mesh/mesh_reader.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/ply_points.h"
#include "toolkit/run/run_reader.h"
#include "vtk_views/files/vtp_surface.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// What stands after `key` in a header, up to the end of its line.
std::string valueOf(std::string_view header, std::string_view key) {
  const auto at = header.find(key);
  if (at == header.npos) return {};
  const std::string_view rest = header.substr(at + key.size());
  return std::string(rest.substr(0, rest.find_first_of("\r\n")));
}

void readRemarks(std::string_view bytes, ModelSurface& surface) {
  const std::string_view header = bytes.substr(0, bytes.find("end_header"));
  surface.frame = valueOf(header, "comment frame ");
  surface.space = valueOf(header, "SPACE=").substr(0, 3);
  if (surface.space != "LPS" && surface.space != "RAS") surface.space.clear();
}

ModelSurface pointsOf(std::string_view bytes, const std::string& name, double unit_mm) {
  ModelFile file = parseModel(bytes, name, unit_mm);
  ModelSurface surface;
  surface.vertices.points_mm = std::move(file.model.positions_mm);
  if (file.with_normals) surface.vertices.normals = std::move(file.model.normals);
  if (file.coloured) surface.vertices.colours = std::move(file.model.colours);
  if (file.weighted) surface.vertices.weights = std::move(file.model.weights);
  surface.vertices.sigmas_mm = std::move(file.sigmas_mm);
  readRemarks(bytes, surface);
  return surface;
}

ModelSurface surfaceOf(TriangleMesh mesh) {
  ModelSurface surface;
  surface.vertices.points_mm = std::move(mesh.vertices_mm);
  surface.vertices.colours = std::move(mesh.colours);
  surface.triangles = std::move(mesh.triangles);
  surface.space = mesh.space;
  return surface;
}

ModelSurface vtkSurfaceOf(const fs::path& file, double unit_mm) {
  requireFile(file);
  TriangleMesh mesh = readVtkSurface(file.string(), unit_mm);
  if (mesh.triangles.empty())
    throw InputError(
        shown(file) +
        ": contains points without triangles; give the PLY of the same model, which has normals");
  return surfaceOf(std::move(mesh));
}

double timeOrNumber(const JudgedRun& run, int frame) {
  const auto found = std::find(run.frames.begin(), run.frames.end(), frame);
  if (found == run.frames.end()) return frame;
  return run.trajectory[std::size_t(found - run.frames.begin())].time_s;
}

}  // namespace

std::vector<SavedModel> savedModels(const fs::path& folder, int every) {
  require(every >= 1, "`every=`", every, "must be 1 (each saved model) or more");
  const JudgedRun run = openJudgedRun(folder);
  if (run.models.empty())
    throw InputError(shown(folder / "models") +
                     ": no saved models; reconstruct with `save_every=` N, or export the last one");
  std::vector<SavedModel> models;
  int count = 0;
  for (const auto& [frame, file] : run.models)
    if (count++ % every == 0) models.push_back({file, frame, timeOrNumber(run, frame)});
  return models;
}

SavedModel savedModel(const fs::path& folder, int frame) {
  if (frame < 0) {
    const fs::path last = folder / "model.ply";
    if (!fs::exists(last))
      throw InputError(shown(last) +
                       ": is missing; give the folder that softscope reconstruct wrote, or a file");
    return {last, -1, 0};
  }
  std::string known;
  for (const SavedModel& model : savedModels(folder, 1)) {
    if (model.frame == frame) return model;
    known += (known.empty() ? "" : ", ") + std::to_string(model.frame);
  }
  throw OptionError("`frame=` is " + std::to_string(frame) + ", but saved are the frames " + known);
}

ModelSurface readModelSurface(const fs::path& file, double unit_mm) {
  const MeshReadOptions options{unit_mm};
  options.validate();
  ModelSurface surface;
  if (looksLikeVtkSurface(file.string())) {
    surface = vtkSurfaceOf(file, unit_mm);
  } else {
    const std::string bytes = readBytes(file, std::uintmax_t{2} << 30), name = shown(file);
    surface = isPlyOfPoints(bytes, name) ? pointsOf(bytes, name, unit_mm)
                                         : surfaceOf(parseMesh(bytes, name, options));
    if (!surface.triangles.empty() && bytes.substr(0, 3) == "ply") readRemarks(bytes, surface);
  }
  return surface;
}

}  // namespace softscope
