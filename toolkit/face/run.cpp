// toolkit/face/run.cpp: of include/softscope/run.h.
#include "softscope/run.h"

#include <filesystem>

#include "io/files/folder.h"
#include "io/text/message.h"
#include "toolkit/face/model_copy.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/run_reader.h"

namespace softscope::api {

namespace fs = std::filesystem;

std::vector<float> floatsOf(const std::vector<Eigen::Vector3f>& vectors) {
  const float* begin = vectors.empty() ? nullptr : vectors.front().data();
  return std::vector<float>(begin, begin + 3 * vectors.size());
}

Model modelOf(const std::vector<Eigen::Vector3f>& points_mm,
              const std::vector<Eigen::Vector3f>& normals, const std::vector<Rgb8>& colours,
              const std::vector<float>& weights, std::vector<float> sigmas_mm) {
  Model model{floatsOf(points_mm), floatsOf(normals), {}, weights, std::move(sigmas_mm)};
  for (const Rgb8& colour : colours)
    model.colours.insert(model.colours.end(), {colour.red, colour.green, colour.blue});
  return model;
}

Pose poseOf(const Eigen::Isometry3d& pose) {
  Pose rows{};
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows.data()) = pose.matrix();
  return rows;
}

Run::Run(std::string folder) : folder_(std::move(folder)) {
  const JudgedRun run = openJudgedRun(folder_);
  frames_ = run.frames;
  for (const TimedPose& timed : run.trajectory) poses_.push_back(poseOf(timed.world_from_left));
  for (const auto& [frame, file] : run.models) saved_.push_back(frame);
}

namespace {

Model readModelAt(const fs::path& file) {
  ModelFile read = readModel(file);
  const PointModel& model = read.model;
  return modelOf(model.positions_mm, model.normals, model.colours, model.weights,
                 std::move(read.sigmas_mm));
}

}  // namespace

Model Run::model() const { return readModelAt(fs::path(folder_) / "model.ply"); }

Model Run::model(int frame) const {
  return readModelAt(fs::path(folder_) / "models" / numberedName(frame, ".ply"));
}

}  // namespace softscope::api
