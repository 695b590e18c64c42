// eval/distance/pseudo_normals.h: sign of a distance from normals of faces, edges and vertices.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Angle-weighted pseudo-normals (Baerentzen and Aanaes, IEEE TVCG 2005): for
/// the closest point c of the surface to p, p is outside if (p - c) . n > 0,
/// with the pseudo-normal n of the face, edge or vertex that contains c.
class PseudoNormals {
 public:
  /// Requires valid indices and finite vertices.
  explicit PseudoNormals(const TriangleMesh& mesh);

  struct Side {
    Eigen::Vector3d normal;  // not normalised; zero if all adjacent triangles are degenerate
    bool on_border;  // an adjacent edge is not closed: its two directions are not equally frequent
  };

  /// Unit normal of a triangle, zero for a degenerate triangle.
  const Eigen::Vector3d& ofFace(std::int32_t triangle) const { return face_normals_[triangle]; }
  Side ofEdge(std::int32_t from, std::int32_t to) const;
  Side ofVertex(std::int32_t vertex) const {
    return {vertex_normals_[vertex], vertex_on_border_[vertex] != 0};
  }

  /// Component of `away_mm`, from a point of the edge or vertex, perpendicular
  /// to the normal of the adjacent triangle with the steepest angle.
  double asideOfEdge(std::int32_t from, std::int32_t to, const Eigen::Vector3d& away_mm) const;
  double asideOfVertex(std::int32_t vertex, const Eigen::Vector3d& away_mm) const;

 private:
  void listCornersByVertex();
  void computeFaces(const TriangleMesh& mesh);
  void sumVertices();

  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> face_normals_;
  std::vector<double> corner_angles_rad_;   // three per triangle
  std::vector<std::int32_t> first_corner_;  // by vertex, into corners_
  std::vector<std::int32_t> corners_;       // 3 * triangle + corner, by vertex
  std::vector<Eigen::Vector3d> vertex_normals_;
  std::vector<std::uint8_t> vertex_on_border_;
};

}  // namespace softscope
