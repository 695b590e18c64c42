#include "stereo/matching/delaunay.h"

// The Voronoi diagram of Boost.Polygon is exact for integer coordinates; its dual is Delaunay's.
#include <boost/polygon/voronoi.hpp>

namespace boost {
namespace polygon {
template <>
struct geometry_concept<Eigen::Vector2i> {
  using type = point_concept;
};
template <>
struct point_traits<Eigen::Vector2i> {
  using coordinate_type = int;
  static int get(const Eigen::Vector2i& point, orientation_2d axis) {
    return axis == HORIZONTAL ? point.x() : point.y();
  }
};
}  // namespace polygon
}  // namespace boost

namespace softscope {

std::vector<std::array<int, 3>> delaunay(const std::vector<Eigen::Vector2i>& points) {
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(2 * points.size());
  for (const auto& vertex : diagram.vertices()) {
    // The cells around a Voronoi vertex are the corners of a polygon on one circle: fan it.
    const auto* first_edge = vertex.incident_edge();
    const int first = static_cast<int>(first_edge->cell()->source_index());
    const auto* edge = first_edge->rot_next();
    int previous = static_cast<int>(edge->cell()->source_index());
    for (edge = edge->rot_next(); edge != first_edge; edge = edge->rot_next()) {
      const int next = static_cast<int>(edge->cell()->source_index());
      triangles.push_back({first, previous, next});
      previous = next;
    }
  }
  return triangles;
}

}  // namespace softscope
