// toolkit/viewer/view_errors.cpp: distances to a surface, or error maps of an evaluation.
#include "toolkit/viewer/view_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/statistics/statistics.h"
#include "eval/surfaces/surface_alignment.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "mesh/mesh_reader.h"
#include "toolkit/comparison/compare_inputs.h"
#include "toolkit/evaluation/evaluate_maps.h"
#include "toolkit/run/provenance.h"
#include "vtk_views/files/error_map.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kSameMm = 0.01;  // tolerance of the match of map and model: rounding of floats

void distances(const TriangleTree& tree, bool with_sign, ViewMoment& moment) {
  moment.judged.vertices_mm = moment.model.vertices_mm;
  moment.errors_mm.clear();
  for (const ClosestPoint& closest : tree.closestPoints(moment.model.vertices_mm))
    moment.errors_mm.push_back(with_sign ? closest.signed_distance_mm : closest.distance_mm);
}

/// Static mesh.
class StillReference : public MomentErrors {
 public:
  explicit StillReference(TriangleMesh mesh)
      : mesh_(std::make_shared<const TriangleMesh>(std::move(mesh))), tree_(*mesh_) {}

  std::shared_ptr<const TriangleMesh> reference(const ViewMoment&) override { return mesh_; }
  void judge(bool with_sign, ViewMoment& moment) override { distances(tree_, with_sign, moment); }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  TriangleTree tree_;
};

/// True meshes of selected frames, in the camera frame of each.
class TrueReference : public MomentErrors {
 public:
  TrueReference(const fs::path& sequence, const fs::path& run)
      : truth_(openSequenceTruth(sequence)) {
    if (truth_.meshes.empty())
      throw InputError(shown(sequence) +
                       ": has no true meshes (groundtruth/mesh); give a sequence that has, or a "
                       "mesh");
    warnings_ = checkOrigin(run, truth_);
  }

  std::vector<std::string> warnings() const override { return warnings_; }

  std::shared_ptr<const TriangleMesh> reference(const ViewMoment& moment) override {
    const auto file = truth_.meshes.find(moment.frame);
    const auto pose = truth_.poses.find(moment.frame);
    if (file == truth_.meshes.end() || pose == truth_.poses.end() || !moment.world_from_left)
      return nullptr;
    if (moment.frame == frame_) return mesh_;
    TriangleMesh mesh = readMesh(file->second);
    mesh.vertices_mm = movePoints(*moment.world_from_left * pose->second.world_from_left.inverse(),
                                  mesh.vertices_mm);
    frame_ = moment.frame;
    mesh_ = std::make_shared<const TriangleMesh>(std::move(mesh));
    return mesh_;
  }

  void judge(bool with_sign, ViewMoment& moment) override {
    if (const auto mesh = reference(moment)) distances(TriangleTree(*mesh), with_sign, moment);
  }

 private:
  SequenceTruth truth_;
  std::vector<std::string> warnings_;
  int frame_ = -1;
  std::shared_ptr<const TriangleMesh> mesh_;  // mesh of that frame
};

class Evaluated : public MomentErrors {
 public:
  explicit Evaluated(const fs::path& folder) {
    requireFolder(folder);
    if (fs::is_directory(folder / "errors"))
      for (const fs::path& file : filesIn(folder / "errors", {".vtp"}))
        if (const auto number = frameNumber(file)) files_[int(*number)] = file;
    if (files_.empty())
      throw InputError(shown(folder) +
                       ": contains no errors/NNNNNN.vtp; give a folder that softscope evaluate "
                       "wrote for this run with `out=`");
  }

  std::shared_ptr<const TriangleMesh> reference(const ViewMoment&) override { return nullptr; }

  void judge(bool with_sign, ViewMoment& moment) override {
    const auto file = files_.find(moment.frame);
    if (file == files_.end()) return;
    const std::string name = shown(file->second);
    const ErrorMap map = parseErrorMap(readBytes(file->second), name);
    moment.judged.vertices_mm = pointsOf(map, moment.model.vertices_mm, name);
    const std::vector<float>& errors_mm = with_sign ? map.signed_mm : map.absolute_mm;
    moment.errors_mm.assign(errors_mm.begin(), errors_mm.end());
  }

 private:
  /// Points of the model that the map contains, in the world of the run. The map is in the
  /// space of the reference: if no rigid transform aligns them, it belongs to another model.
  static std::vector<Eigen::Vector3f> pointsOf(const ErrorMap& map,
                                               const std::vector<Eigen::Vector3f>& model_mm,
                                               const std::string& name) {
    const std::vector<std::size_t> kept = indicesOfMap(model_mm.size());
    const std::vector<Eigen::Vector3f>& there = map.surface.vertices_mm;
    bool same = kept.size() == there.size();
    std::vector<Eigen::Vector3f> points;
    if (same) {
      for (const std::size_t i : kept) points.push_back(model_mm[i]);
      same = areMoved(points, there);
    }
    if (!same)
      throw InputError(name +
                       ": was measured on another model of this frame; evaluate the run "
                       "again");
    return points;
  }

  static bool areMoved(const std::vector<Eigen::Vector3f>& from,
                       const std::vector<Eigen::Vector3f>& to) {
    const std::size_t step = std::max<std::size_t>(1, from.size() / 500);
    const auto count = Eigen::Index((from.size() + step - 1) / step);
    Eigen::Matrix3Xd a(3, count), b(3, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      a.col(k) = from[std::size_t(k) * step].cast<double>();
      b.col(k) = to[std::size_t(k) * step].cast<double>();
    }
    const Eigen::Matrix4d move = Eigen::umeyama(a, b, /*with_scaling=*/false);
    const Eigen::Matrix3Xd rest =
        (move.topLeftCorner<3, 3>() * a).colwise() + move.topRightCorner<3, 1>() - b;
    return rest.colwise().norm().maxCoeff() < kSameMm;
  }

  std::map<int, fs::path> files_;
};

}  // namespace

std::unique_ptr<MomentErrors> errorsFromReference(const fs::path& reference, const fs::path& run,
                                                  const Eigen::Isometry3d& reference_from_run) {
  if (fs::is_directory(reference)) return std::make_unique<TrueReference>(reference, run);
  TriangleMesh mesh = readSurfaceOrPoints(reference, kUnitOfFile);
  if (mesh.empty())
    throw InputError(shown(reference) +
                     ": is a set of points, but the reference must be a surface; give a mesh, or a "
                     "sequence with groundtruth/");
  if (mesh.space == "RAS")
    for (Eigen::Vector3f& p : mesh.vertices_mm) p.head<2>() = -p.head<2>();
  mesh.vertices_mm = movePoints(reference_from_run.inverse(), mesh.vertices_mm);
  return std::make_unique<StillReference>(std::move(mesh));
}

std::unique_ptr<MomentErrors> errorsFromEvaluation(const fs::path& folder) {
  return std::make_unique<Evaluated>(folder);
}

void chooseErrorColours(const std::vector<double>& errors_mm, const ErrorColourOptions& options,
                        ViewWorld& world) {
  std::vector<double> absolute_mm;
  for (const double error_mm : errors_mm) absolute_mm.push_back(std::abs(error_mm));
  const SurfaceErrorMap map = colourErrors(absolute_mm, errors_mm, options);
  world.errors = map.colours;
  world.error_label = map.bar.label;
}

}  // namespace softscope
