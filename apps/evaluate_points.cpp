// apps/evaluate_points.cpp: header by src/mesh, positions copied straight from the bytes.
#include "apps/evaluate_points.h"

#include <cstring>

#include "core/error.h"
#include "io/file_bytes.h"
#include "io/message.h"
#include "mesh/ply_header.h"

namespace softscope {
namespace {

constexpr float kFarthestMm = 1e6f;

const PlyElement& verticesOf(const PlyHeader& header, const std::string& name) {
  if (header.encoding != PlyEncoding::kLittleEndian)
    throw InputError(name +
                     ": a model is a binary little-endian PLY, but this is another kind; "
                     "give a folder that softscope reconstruct wrote");
  if (header.elements.empty() || header.elements[0].name != "vertex")
    throw InputError(name + ": the first element is no vertex; give a model of points");
  return header.elements[0];
}

struct Layout {
  std::size_t stride = 0;
  std::size_t x = 0;  // y and z follow it at once
};

Layout layoutOf(const PlyElement& vertices, const std::string& name) {
  Layout layout;
  std::size_t found = 0;
  for (const PlyProperty& property : vertices.properties) {
    if (property.is_list) throw InputError(name + ": points with lists are no model");
    const std::size_t axis = std::string("xyz").find(property.name);
    if (property.name.size() == 1 && axis != std::string::npos &&
        property.type == PlyType::kFloat) {
      if (axis == 0) layout.x = layout.stride;
      if (axis == found && layout.stride == layout.x + 4 * axis) ++found;
    }
    layout.stride += static_cast<std::size_t>(sizeOf(property.type));
  }
  if (found != 3)
    throw InputError(name +
                     ": its points have no x, y, z as floats one after the other; give a "
                     "model that softscope reconstruct wrote");
  return layout;
}

void requirePlausible(const Eigen::Vector3f& point_mm, std::size_t index, const std::string& name) {
  if (point_mm.cwiseAbs().maxCoeff() <= kFarthestMm && point_mm.allFinite()) return;
  throw InputError(say(name, ": point ", index, " is ", point_mm.x(), " ", point_mm.y(), " ",
                       point_mm.z(),
                       ", but a model has finite coordinates within 1 km, in mm; "
                       "is the file damaged?"));
}

}  // namespace

std::vector<Eigen::Vector3f> parseModelPoints(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, 4) != "ply\n" && bytes.substr(0, 4) != "ply\r")
    throw InputError(name + ": is no PLY file; give a model that softscope reconstruct wrote");
  const PlyHeader header = parsePlyHeader(bytes, name);  // promises no more than there is
  const PlyElement& vertices = verticesOf(header, name);
  const Layout layout = layoutOf(vertices, name);
  if (vertices.count == 0)
    throw InputError(name + ": holds no point; was the run lost from its first frame on?");
  std::vector<Eigen::Vector3f> points_mm(vertices.count);
  const char* at = bytes.data() + header.bytes + layout.x;
  for (std::size_t i = 0; i < points_mm.size(); ++i, at += layout.stride) {
    std::memcpy(points_mm[i].data(), at, 3 * sizeof(float));
    requirePlausible(points_mm[i], i, name);
  }
  return points_mm;
}

std::vector<Eigen::Vector3f> readModelPoints(const std::filesystem::path& file) {
  return parseModelPoints(readBytes(file), shown(file));
}

}  // namespace softscope
