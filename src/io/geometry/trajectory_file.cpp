#include "io/geometry/trajectory_file.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/farthest.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

constexpr double kQuaternionTolerance = 0.01;
using Numbers = std::array<double, 8>;

Numbers numbersOf(std::string_view line, const std::string& where) {
  Numbers out{};
  const auto words = wordsOf(line);
  if (words.size() != out.size())
    throw InputError(
        say(where, " has ", words.size(), " words, but time_s tx ty tz qx qy qz qw are expected."));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto value = numberOf(words[i]);
    if (!value || !std::isfinite(*value))
      throw InputError(say(where, " holds ", excerpt(words[i]), ", but a number is expected."));
    out[i] = *value;
  }
  return out;
}

TimedPose poseOf(const Numbers& n, const std::string& where) {
  const Eigen::Quaterniond rotation(n[7], n[4], n[5], n[6]);
  if (!(std::abs(rotation.norm() - 1) <= kQuaternionTolerance))
    throw InputError(say(where, " has a quaternion of length ", rotation.norm(),
                         ", but 1 is expected. The order is qx qy qz qw."));
  TimedPose out;
  out.time_s = n[0];
  out.world_from_left.linear() = rotation.normalized().toRotationMatrix();
  out.world_from_left.translation() = Eigen::Vector3d(n[1], n[2], n[3]);
  const double away_mm = out.world_from_left.translation().norm();
  if (!(away_mm <= kFarthestMm))
    throw InputError(say(where, " holds a place ", away_mm,
                         " mm from the origin, but one within 1 km is expected; is the file "
                         "damaged?"));
  return out;
}

}  // namespace

Trajectory parseTrajectory(std::string_view text, const std::string& name) {
  Trajectory out;
  int line_number = 0;
  for (const std::string_view line : linesOf(text)) {
    ++line_number;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    const std::string where = say(name, ": line ", line_number);
    out.push_back(poseOf(numbersOf(content, where), where));
    if (out.size() > 1 && out.back().time_s < out[out.size() - 2].time_s)
      throw InputError(
          say(where, " is of ", out.back().time_s, " s, before the line above. Sort it."));
  }
  if (out.empty()) throw InputError(name + ": holds no pose. Is it the right file?");
  return out;
}

Trajectory readTrajectory(const std::filesystem::path& file) {
  return parseTrajectory(readText(file, kTextLimitBytes), shown(file));
}

std::string trajectoryText(const Trajectory& trajectory) {
  std::string out = "# time_s tx ty tz qx qy qz qw: world_from_left, mm\n";
  std::array<char, 256> line{};
  for (const TimedPose& pose : trajectory) {
    const Eigen::Vector3d t = pose.world_from_left.translation();
    const Eigen::Quaterniond q(pose.world_from_left.linear());
    // Larger numbers are not lengths in mm, and would exceed the line buffer.
    if (!(std::abs(pose.time_s) < 1e12 && t.cwiseAbs().maxCoeff() < 1e12 && q.coeffs().allFinite()))
      throw Error(say("a trajectory holds a pose that is not finite, at ", pose.time_s, " s."));
    std::snprintf(line.data(), line.size(), "%.6f %.6f %.6f %.6f %.9f %.9f %.9f %.9f\n",
                  pose.time_s, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
    out += line.data();
  }
  return out;
}

std::string kittiText(const Trajectory& trajectory) {
  if (trajectory.empty()) return {};
  std::string out;
  std::array<char, 32> number{};
  for (const TimedPose& pose : parseTrajectory(trajectoryText(trajectory), "trajectory"))
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) {
        std::snprintf(number.data(), number.size(), "%.9g",
                      pose.world_from_left.matrix()(row, column));
        out += number.data();
        out += row == 2 && column == 3 ? '\n' : ' ';
      }
  return out;
}

void writeTrajectory(const std::filesystem::path& file, const Trajectory& trajectory,
                     bool overwrite) {
  requireWritable(file, overwrite);
  writeFile(file, trajectoryText(trajectory), overwrite);
}

}  // namespace softscope
