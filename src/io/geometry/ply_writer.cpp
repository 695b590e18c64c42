#include "io/geometry/ply_writer.h"

#include <cstdint>
#include <cstring>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/text/message.h"

namespace softscope {
namespace {

void requireOnePerPoint(std::size_t count, const PointCloud& cloud, const char* what) {
  if (count == 0 || count == cloud.points_mm.size()) return;
  throw Error(say("a point cloud has ", count, " ", what, ", but ", cloud.points_mm.size(),
                  " points; one a point, or none, is expected."));
}

std::string headerOf(const PointCloud& cloud, const PlyComments& comments) {
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment unit mm\n";
  if (!comments.frame.empty()) out += say("comment frame ", comments.frame, "\n");
  if (!comments.space.empty()) out += say("comment SPACE=", comments.space, "\n");
  for (const std::string& line : comments.more) out += "comment " + line + "\n";
  out += say("element vertex ", cloud.points_mm.size(), "\n");
  out += "property float x\nproperty float y\nproperty float z\n";
  if (!cloud.normals.empty()) out += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!cloud.colours.empty())
    out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!cloud.weights.empty()) out += "property float weight\n";
  if (!cloud.sigmas_mm.empty()) out += "property float sigma_mm\n";
  return out + "end_header\n";
}

void append(std::string& out, float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, 4);
  char bytes[4];
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(bits >> (8 * i) & 0xFF);
  out.append(bytes, 4);
}

void append(std::string& out, const Eigen::Vector3f& vector) {
  for (int axis = 0; axis < 3; ++axis) append(out, vector[axis]);
}

void append(std::string& out, const Rgb8& colour) {
  for (const std::uint8_t channel : {colour.red, colour.green, colour.blue})
    out += static_cast<char>(channel);
}

}  // namespace

std::string plyBytes(const PointCloud& cloud, const PlyComments& comments) {
  requireOnePerPoint(cloud.normals.size(), cloud, "normals");
  requireOnePerPoint(cloud.colours.size(), cloud, "colours");
  requireOnePerPoint(cloud.weights.size(), cloud, "weights");
  requireOnePerPoint(cloud.sigmas_mm.size(), cloud, "sigmas");
  std::string out = headerOf(cloud, comments);
  out.reserve(out.size() + 35 * cloud.points_mm.size());
  for (std::size_t i = 0; i < cloud.points_mm.size(); ++i) {
    append(out, cloud.points_mm[i]);
    if (!cloud.normals.empty())
      append(out, cloud.normals[i].allFinite() ? cloud.normals[i] : Eigen::Vector3f(0, 0, 0));
    if (!cloud.colours.empty()) append(out, cloud.colours[i]);
    if (!cloud.weights.empty()) append(out, cloud.weights[i]);
    if (!cloud.sigmas_mm.empty()) append(out, cloud.sigmas_mm[i]);
  }
  return out;
}

void writePly(const std::filesystem::path& file, const PointCloud& cloud,
              const PlyComments& comments, bool overwrite) {
  requireWritable(file, overwrite);
  writeFile(file, plyBytes(cloud, comments), overwrite);
}

}  // namespace softscope
