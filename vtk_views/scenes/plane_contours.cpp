// vtk_views/scenes/plane_contours.cpp: signs of vertices,
// segments of triangles, joined at shared edges.
#include "vtk_views/scenes/plane_contours.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/parallel.h"

namespace softscope {
namespace {

using EdgeKey = std::uint64_t;  // two vertices, the lower index in the upper half

EdgeKey edgeOf(std::int32_t a, std::int32_t b) {
  const auto low = static_cast<std::uint32_t>(std::min(a, b));
  const auto high = static_cast<std::uint32_t>(std::max(a, b));
  return EdgeKey(low) << 32 | high;
}

/// Segment in one triangle: its two intersected edges.
using Piece = std::array<EdgeKey, 2>;

std::vector<float> heightsOver(const SectionPlane& plane,
                               const std::vector<Eigen::Vector3f>& points) {
  const double offset = plane.normal.dot(plane.point_mm);
  const double nx = plane.normal.x(), ny = plane.normal.y(), nz = plane.normal.z();
  std::vector<float> heights(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    heights[i] = float(nx * points[i][0] + ny * points[i][1] + nz * points[i][2] - offset);
  return heights;
}

std::vector<Piece> piecesOf(const TriangleMesh& mesh, const std::vector<float>& heights) {
  std::vector<std::uint8_t> above(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) above[i] = heights[i] >= 0;
  std::vector<Piece> pieces;
  for (const Triangle& t : mesh.triangles) {
    const int a = above[std::size_t(t[0])], b = above[std::size_t(t[1])],
              c = above[std::size_t(t[2])];
    if (a == b && b == c) continue;
    const int lone = a == b ? 2 : (a == c ? 1 : 0);  // vertex alone on its side
    const std::int32_t tip = t[std::size_t(lone)];
    pieces.push_back(
        {edgeOf(tip, t[std::size_t((lone + 1) % 3)]), edgeOf(tip, t[std::size_t((lone + 2) % 3)])});
  }
  return pieces;
}

/// For each end (2 * piece + side) the joined end; -1 at a border.
std::vector<std::int32_t> joinEnds(const std::vector<Piece>& pieces) {
  std::vector<std::pair<EdgeKey, std::int32_t>> ends;
  ends.reserve(2 * pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t side = 0; side < 2; ++side)
      ends.emplace_back(pieces[i][side], static_cast<std::int32_t>(2 * i + side));
  std::sort(ends.begin(), ends.end());
  std::vector<std::int32_t> partner(ends.size(), -1);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (ends[i].first == ends[i + 1].first) {
      partner[std::size_t(ends[i].second)] = ends[i + 1].second;
      partner[std::size_t(ends[i + 1].second)] = ends[i].second;
      ++i;
    }
  return partner;
}

class Joiner {
 public:
  Joiner(const TriangleMesh& mesh, const std::vector<float>& heights)
      : mesh_(mesh),
        heights_(heights),
        pieces_(piecesOf(mesh, heights)),
        partner_(joinEnds(pieces_)),
        used_(pieces_.size(), 0) {}

  std::vector<ContourLine> lines() {
    std::vector<ContourLine> lines;
    for (std::size_t end = 0; end < partner_.size(); ++end)  // open lines from their ends
      if (partner_[end] < 0 && !used_[end / 2]) lines.push_back(follow(std::int32_t(end)));
    for (std::size_t piece = 0; piece < pieces_.size(); ++piece)
      if (!used_[piece]) lines.push_back(follow(std::int32_t(2 * piece)));
    return lines;
  }

 private:
  ContourLine follow(std::int32_t end) {
    ContourLine line{pointAt(end)};
    while (end >= 0 && !used_[std::size_t(end / 2)]) {
      used_[std::size_t(end / 2)] = 1;
      const std::int32_t other = end ^ 1;
      line.push_back(pointAt(other));
      end = partner_[std::size_t(other)];
    }
    return line;
  }

  Eigen::Vector3f pointAt(std::int32_t end) const {
    const EdgeKey edge = pieces_[std::size_t(end / 2)][std::size_t(end % 2)];
    const auto a = std::size_t(edge >> 32), b = std::size_t(edge & 0xffffffffu);
    const float part = heights_[a] / (heights_[a] - heights_[b]);  // different signs: never 0 / 0
    return mesh_.vertices_mm[a] + part * (mesh_.vertices_mm[b] - mesh_.vertices_mm[a]);
  }

  const TriangleMesh& mesh_;
  const std::vector<float>& heights_;
  std::vector<Piece> pieces_;
  std::vector<std::int32_t> partner_;
  std::vector<std::uint8_t> used_;
};

}  // namespace

std::vector<ContourLine> planeContours(const TriangleMesh& mesh, const SectionPlane& plane) {
  const std::vector<float> heights = heightsOver(plane, mesh.vertices_mm);
  return Joiner(mesh, heights).lines();
}

std::vector<std::vector<ContourLine>> planeContours(const TriangleMesh& mesh,
                                                    const std::vector<SectionPlane>& planes) {
  std::vector<std::vector<ContourLine>> contours(planes.size());
  parallelRanges(static_cast<int>(planes.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      contours[std::size_t(i)] = planeContours(mesh, planes[std::size_t(i)]);
  });
  return contours;
}

std::vector<Eigen::Vector3f> pointsNearPlane(const std::vector<Eigen::Vector3f>& points_mm,
                                             const SectionPlane& plane, double reach_mm) {
  const std::vector<float> heights = heightsOver(plane, points_mm);
  std::vector<Eigen::Vector3f> near;
  for (std::size_t i = 0; i < points_mm.size(); ++i)
    if (std::abs(heights[i]) <= reach_mm) near.push_back(points_mm[i]);
  return near;
}

}  // namespace softscope
