// toolkit/figures/scene_inputs.cpp: checks of spaces, units and overlap.
#include "toolkit/figures/scene_inputs.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include "core/error.h"
#include "eval/surfaces/surface_alignment.h"
#include "io/files/file_hash.h"
#include "io/text/message.h"
#include "mesh/mesh_check.h"
#include "toolkit/comparison/compare_inputs.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/run/model_surface.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

/// Description of the transform of the mesh into LPS.
std::string transformToLps(TriangleMesh& mesh) {
  if (mesh.space.empty()) return "unknown; assumed LPS";
  if (mesh.space == "LPS") return "LPS";
  for (Eigen::Vector3f& p : mesh.vertices_mm) p.head<2>() = -p.head<2>();
  const std::string was = mesh.space;
  mesh.space = "LPS";
  return was + "; x and y negated";
}

/// "world", "left" …: camera frame in the header of a PLY of softscope.
std::string frameOf(const std::string& path) {
  char head[512] = {};
  std::ifstream(path, std::ios::binary).read(head, sizeof head - 1);
  const std::string_view text(head);
  constexpr std::string_view kKey = "comment frame ";
  const auto at = text.find(kKey);
  if (text.substr(0, 3) != "ply" || at == text.npos) return {};
  const std::string_view rest = text.substr(at + kKey.size());
  return std::string(rest.substr(0, rest.find('\n')));
}

/// A model of reconstruct is drawn as a surface; other point clouds remain points.
void addTriangles(const std::string& path, TriangleMesh& mesh) {
  try {
    const TriangleMesh surface = modelSurface(readModel(path));
    if (surface.vertices_mm.size() == mesh.vertices_mm.size()) mesh.triangles = surface.triangles;
  } catch (const InputError&) {  // point cloud of another program
  }
}

}  // namespace

void SceneInputs::note(const std::string& role, const std::string& path) {
  sources_.push_back({role, path});
}

void SceneInputs::addVolume(const std::string& path, const std::string& window,
                            const VolumeOptions& options) {
  scene_.volume = readVolume(path, options);
  scene_.window = parseWindow(window, *scene_.volume);
  if (scene_.volume->facts.file_space == "unknown") scene_.frame = SceneFrame::kAxes;
  note("volume", path);
  for (const std::string& warning : scene_.volume->facts.warnings) warn(path + ": " + warning);
}

SceneSurface& SceneInputs::addSurface(const std::string& path, const std::string& role,
                                      const std::string& legend, Rgb8 colour) {
  SceneSurface surface;
  surface.name = legend;
  surface.mesh = readSurfaceOrPoints(path, unit_mm_);
  surface.colour = colour;
  frames_.push_back(surface.mesh.space.empty() ? frameOf(path) : "");
  space_is_said_ |= !surface.mesh.space.empty();
  if (!frames_.back().empty() && surface.isPoints()) addTriangles(path, surface.mesh);
  assumptions_.push_back(frames_.back().empty() ? transformToLps(surface.mesh)
                                                : "a scope's frame: " + frames_.back());
  surface_paths_.push_back(path);
  note(role, path);
  scene_.surfaces.push_back(std::move(surface));
  return scene_.surfaces.back();
}

SceneSurface& SceneInputs::addMade(SceneSurface surface, const std::string& role,
                                   const std::filesystem::path& path) {
  frames_.emplace_back();
  assumptions_.push_back("camera frame");
  surface_paths_.push_back(path.string());
  note(role, path.string());
  scene_.surfaces.push_back(std::move(surface));
  return scene_.surfaces.back();
}

void SceneInputs::move(std::size_t index, const Eigen::Isometry3d& motion, const std::string& how) {
  auto& points_mm = scene_.surfaces[index].mesh.vertices_mm;
  points_mm = movePoints(motion, points_mm);
  frames_[index].clear();
  assumptions_[index] += "; aligned: " + how;
}

void SceneInputs::checkFrames() {
  const auto of_scope = [](const std::string& frame) { return !frame.empty(); };
  if (!scene_.volume && !frames_.empty() && std::all_of(frames_.begin(), frames_.end(), of_scope)) {
    scene_.frame = SceneFrame::kCamera;
    return;
  }
  if (!scene_.volume && !space_is_said_) scene_.frame = SceneFrame::kAxes;
  for (std::size_t i = 0; i < frames_.size(); ++i)
    if (of_scope(frames_[i]))
      warn(surface_paths_[i] + ": is in a camera frame (" + frames_[i] +
           "), so its position relative to the others is undefined unless it was registered; then "
           "write SPACE=LPS into its header");
}

void SceneInputs::checkPlaces() {
  checkFrames();
  for (std::size_t i = 0; i < surface_paths_.size(); ++i) {
    const TriangleMesh& mesh = scene_.surfaces[i].mesh;
    if (!mesh.empty()) {
      const double unit_mm = checkMesh(mesh).likely_unit_mm;
      if (unit_mm != 1)
        warn(say(surface_paths_[i], ": its box is ", boxOf({scene_.surfaces[i]}).sizes().maxCoeff(),
                 " mm long. In another unit? Then give `unit_mm=` ", unit_mm));
    }
    if (!scene_.volume) continue;
    const auto volume = boxOf(*scene_.volume), surface = boxOf({scene_.surfaces[i]});
    if (volume.intersects(surface)) continue;
    warn(say(surface_paths_[i], ": lies ", volume.exteriorDistance(surface.center()),
             " mm outside of the volume; of another patient, or in RAS without a header entry? "
             "Then write SPACE=RAS into its header"));
  }
}

Json SceneInputs::inputsJson() const {
  Json list = Json::array();
  for (const Source& source : sources_)
    list.push_back(
        {{"role", source.role}, {"path", source.path}, {"sha256", sha256Of(source.path)}});
  return list;
}

Json SceneInputs::volumeJson() const {
  if (!scene_.volume) return nullptr;
  const VolumeSummary& facts = scene_.volume->facts;
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    const Eigen::Vector4d r = facts.lps_from_voxel.row(row);
    rows.push_back({r[0], r[1], r[2], r[3]});
  }
  return {{"format", facts.format},
          {"size_voxels", facts.size_voxels},
          {"spacing_mm", facts.spacing_mm},
          {"lps_from_voxel", rows},
          {"hounsfield", scene_.volume->inHounsfield()},
          {"window",
           {{"name", scene_.window.name},
            {"width", scene_.window.width},
            {"level", scene_.window.level}}}};
}

Json SceneInputs::surfacesJson() const {
  Json list = Json::array();
  for (std::size_t i = 0; i < surface_paths_.size(); ++i) {
    const SceneSurface& surface = scene_.surfaces[i];
    const auto box = boxOf({surface});
    list.push_back({{"path", surface_paths_[i]},
                    {"legend", surface.name},
                    {"space", assumptions_[i]},
                    {"unit_mm", surface.mesh.unit_mm},
                    {"vertices", surface.mesh.vertices_mm.size()},
                    {"triangles", surface.mesh.triangles.size()},
                    {"low_mm", vectorJson(box.min())},
                    {"high_mm", vectorJson(box.max())}});
  }
  return list;
}

}  // namespace softscope
