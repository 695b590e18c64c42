#include "io/datasets/c3vd_files.h"

#include <cmath>

#include "core/error.h"
#include "core/farthest.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

constexpr double kRoundingError = 1e-6;  // of the row 0 0 0 1
constexpr double kRotationError = 0.01;  // of R Rᵀ, rounded to few digits on disk
using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

/// Numbers as on disk, row by row.
RowMajor matrixOf(std::string_view line, const std::string& what) {
  const std::vector<std::string_view> words = wordsOf(line);
  RowMajor matrix;
  if (words.size() != 16)
    throw InputError(say(what, " has ", words.size(), " words, but the 16 numbers of a 4 x 4 ",
                         "matrix are expected (C3VD)."));
  for (int i = 0; i < 16; ++i) {
    const auto value = numberOf(words[static_cast<std::size_t>(i)]);
    if (!value || !std::isfinite(*value) || std::abs(*value) > kFarthestMm)
      throw InputError(say(what, ": ", excerpt(words[static_cast<std::size_t>(i)]),
                           ", but a number is expected (C3VD)."));
    matrix(i / 4, i % 4) = *value;
  }
  return matrix;
}

bool hasLastRow(const Eigen::Matrix4d& matrix) {
  return (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() < kRoundingError;
}

Eigen::Isometry3d poseOf(const Eigen::Matrix4d& matrix, const std::string& what) {
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Eigen::Matrix3d rest = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  if (rest.cwiseAbs().maxCoeff() > kRotationError || rotation.determinant() < 0)
    throw InputError(what + ": its 3 x 3 part is no rotation. Download it again.");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

}  // namespace

std::vector<Eigen::Isometry3d> parseC3vdPath(std::string_view text, const std::string& name) {
  std::vector<Eigen::Matrix4d> matrices;
  std::vector<std::string> places;
  bool by_columns = true, by_rows = true;
  int number = 0;
  for (const std::string_view line : linesOf(text)) {
    ++number;
    if (trimmed(line).empty()) continue;
    places.push_back(say(name, ": line ", number));
    matrices.emplace_back(matrixOf(line, places.back()));
    by_columns = by_columns && hasLastRow(matrices.back().transpose());
    by_rows = by_rows && hasLastRow(matrices.back());
    if (!by_columns && !by_rows)
      throw InputError(places.back() +
                       " has no row 0 0 0 1, or its numbers are in another order than those "
                       "before. Is it C3VD's?");
  }
  if (matrices.empty()) throw InputError(name + ": holds no pose, but one per image is expected.");
  std::vector<Eigen::Isometry3d> path;
  for (std::size_t i = 0; i < matrices.size(); ++i)
    path.push_back(
        poseOf(by_columns ? Eigen::Matrix4d(matrices[i].transpose()) : matrices[i], places[i]));
  return path;
}

std::vector<Eigen::Isometry3d> readC3vdPath(const std::filesystem::path& file) {
  return parseC3vdPath(readBytes(file), shown(file));
}

std::string c3vdPathText(const std::vector<Eigen::Isometry3d>& world_from_left) {
  std::string text;
  for (const Eigen::Isometry3d& pose : world_from_left)
    for (int i = 0; i < 16; ++i)
      text += exactText(pose.matrix()(i % 4, i / 4)) + (i == 15 ? "\n" : ",");
  return text;
}

}  // namespace softscope
