// eval/distance/pseudo_normals.h: inside and outside by normals of faces, edges and vertices.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Angle-weighted pseudo-normals (Baerentzen and Aanaes, IEEE TVCG 2005): if c is the surface's
/// closest point to p, then p lies outside where (p - c) . n > 0, with n the pseudo-normal of the
/// face, edge or vertex that c lies on.
class PseudoNormals {
 public:
  /// The mesh must have valid indices and finite vertices.
  explicit PseudoNormals(const TriangleMesh& mesh);

  struct Side {
    Eigen::Vector3d normal;  // not of unit length; zero where all triangles there have no area
    bool on_border;  // some edge there is not closed: not run through both ways equally often
  };

  /// Unit normal of a triangle, zero if it has no area.
  const Eigen::Vector3d& ofFace(std::int32_t triangle) const { return face_normals_[triangle]; }
  Side ofEdge(std::int32_t from, std::int32_t to) const;
  Side ofVertex(std::int32_t vertex) const {
    return {vertex_normals_[vertex], vertex_on_border_[vertex] != 0};
  }

  /// How far `away_mm`, from a point of the edge or vertex, leads beside its triangles' normals: of
  /// the triangle that it leaves most upright.
  double asideOfEdge(std::int32_t from, std::int32_t to, const Eigen::Vector3d& away_mm) const;
  double asideOfVertex(std::int32_t vertex, const Eigen::Vector3d& away_mm) const;

 private:
  void listCornersByVertex();
  void computeFaces(const TriangleMesh& mesh);
  void sumVertices();

  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> face_normals_;
  std::vector<double> corner_angles_rad_;   // 3 a triangle
  std::vector<std::int32_t> first_corner_;  // by vertex, into corners_
  std::vector<std::int32_t> corners_;       // 3 * triangle + corner, by vertex
  std::vector<Eigen::Vector3d> vertex_normals_;
  std::vector<std::uint8_t> vertex_on_border_;
};

}  // namespace softscope
