#include "toolkit/run/saved_model.h"

#include <cstdio>
#include <initializer_list>
#include <string>

#include "core/parallel.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/geometry/ply_writer.h"
#include "io/text/text_lines.h"
#include "toolkit/record/json_text.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/models_on_disk.h"
#include "toolkit/run/out_folder.h"
#include "vtk_views/files/point_cloud_vtp.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// Of a model, or of its nodes.
bool isOfFrame(const fs::path& file) {
  const std::string stem = file.stem().string(), end = file.extension().string();
  return stem.size() == 6 && stem.find_first_not_of("0123456789") == std::string::npos &&
         (end == ".ply" || end == ".vtp" || end == ".csv");
}

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += " " + exactText(value);
  return text;
}

std::vector<std::string> comments(const ModelMoment& moment) {
  const Eigen::Vector3d t = moment.world_from_left.translation();
  const Eigen::Quaterniond q(moment.world_from_left.linear());
  const PinholeCamera& left = moment.left;
  return {"time_s" + numbers({moment.time_s}),
          "world_from_left" + numbers({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}),
          "left_camera" + numbers({double(left.width_px), double(left.height_px), left.fx_px,
                                   left.fy_px, left.cx_px, left.cy_px})};
}

std::string nodesCsv(const std::vector<Eigen::Vector3d>& nodes_mm) {
  std::string text = "node,x_mm,y_mm,z_mm\n";
  char line[120];
  for (std::size_t i = 0; i < nodes_mm.size(); ++i) {
    const Eigen::Vector3d& p = nodes_mm[i];
    std::snprintf(line, sizeof line, "%zu,%.4f,%.4f,%.4f\n", i, p.x(), p.y(), p.z());
    text += line;
  }
  return text;
}

std::vector<Eigen::Vector3d> readNodes(const fs::path& file) {
  std::vector<Eigen::Vector3d> nodes_mm;
  const std::string text = readBytes(file);
  for (const NumberRow& row : numberRows(text))
    if (row.values.size() == 4) nodes_mm.emplace_back(row.values[1], row.values[2], row.values[3]);
  return nodes_mm;
}

PointCloud movedCloud(const ModelFile& model, const Eigen::Isometry3f& motion) {
  PointCloud cloud{model.model.positions_mm, model.model.normals, model.model.colours,
                   model.model.weights, model.sigmas_mm};
  for (Eigen::Vector3f& point_mm : cloud.points_mm) point_mm = motion * point_mm;
  for (Eigen::Vector3f& normal : cloud.normals) normal = motion.linear() * normal;
  return cloud;
}

}  // namespace

void writeSavedModel(const fs::path& run, const ModelMoment& moment, const PointCloud& cloud,
                     const std::vector<Eigen::Vector3d>& nodes_mm) {
  const auto file = [&](const char* folder, const char* end) {
    return run / folder / numberedName(moment.frame, end);
  };
  makeFolder(run / kModels);
  makeFolder(run / kNodes);
  AtomicFile ply(file(kModels, ".ply"), /*overwrite=*/true);
  parallelInvoke(
      [&] {
        ply.write(plyBytes(cloud, {"world", "", comments(moment)}));
      },
      [&] {
        writeFile(file(kNodes, ".csv"), nodesCsv(nodes_mm), true);
        writeFile(file(kModels, ".vtp"), pointCloudVtp(cloud), true);
      });
  ply.commit();  // last: a reader of a growing run that finds the model finds the rest
}

void moveSavedModel(const fs::path& run, const ModelMoment& moment,
                    const Eigen::Isometry3d& into_from) {
  const fs::path path = run / kModels / numberedName(moment.frame, ".ply");
  ModelMoment moved = moment;
  moved.world_from_left = into_from * moment.world_from_left;
  const Eigen::Isometry3d written =
      readModelHead(moment.frame, path).world_from_left.value_or(moment.world_from_left);
  const auto distance = [&](const ModelMoment& other) {
    return (other.world_from_left.matrix() - written.matrix()).norm();
  };
  if (distance(moved) < distance(moment)) return;
  std::vector<Eigen::Vector3d> nodes_mm =
      readNodes(run / kNodes / numberedName(moment.frame, ".csv"));
  for (Eigen::Vector3d& node_mm : nodes_mm) node_mm = into_from * node_mm;
  writeSavedModel(run, moved, movedCloud(readModel(path), into_from.cast<float>()), nodes_mm);
}

void removeSavedModels(const fs::path& run) {
  for (const char* folder : {kModels, kNodes}) {
    if (!fs::is_directory(run / folder)) continue;
    std::vector<fs::path> earlier;
    for (const auto& entry : fs::directory_iterator(run / folder))
      if (isOfFrame(entry.path())) earlier.push_back(entry.path());
    for (const fs::path& path : earlier) fs::remove(path);
  }
}

}  // namespace softscope
