// eval/simulation/tissue/tissue_body.h: simulated organ with the walls of a
// wound.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Position on a triangle of the organ, or on one of its edges or vertices (other shares 0).
struct OrganPlace {
  std::array<std::int32_t, 3> vertices;
  Eigen::Vector3f shares;  // sum 1

  Eigen::Vector3f mixed(const std::vector<Eigen::Vector3f>& values) const {
    return shares[0] * values[vertices[0]] + shares[1] * values[vertices[1]] +
           shares[2] * values[vertices[2]];
  }
};

/// Organ after the cut, before any motion: triangles split along the cut, whose
/// lips coincide, and walls between the lips. Closed if the organ is closed.
struct TissueBody {
  TriangleMesh organ;              // before the cut; its vertices are the first of `mesh`
  TriangleMesh mesh;               // at rest: `skin` triangles first, then the walls
  std::size_t skin_triangles = 0;  // of mesh
  // One per vertex of `mesh`; all empty without a cut.
  std::vector<OrganPlace> places;         // on the organ: for a wall at its lip
  std::vector<float> depth_mm;            // 0: skin; for a wall the depth below its lip
  std::vector<Eigen::Vector3f> below_mm;  // offset from its place, at rest
  std::vector<Eigen::Vector3f> gape_mm;   // displacement by the open wound

  static TissueBody whole(TriangleMesh organ);

  /// `open`: 0 closed, 1 fully open. `organ_mm`: current positions of the vertices of the organ.
  std::vector<Eigen::Vector3f> verticesAt(const std::vector<Eigen::Vector3f>& organ_mm,
                                          float open) const;

  /// Normals of `vertices_mm`, as returned by verticesAt() in
  /// any frame; unit length, or interpolated. Skin normals are
  /// those of the uncut organ: a closed wound changes nothing.
  std::vector<Eigen::Vector3f> normalsOf(const std::vector<Eigen::Vector3f>& vertices_mm) const;

  /// Triangles for ray casting: without the coincident walls of a closed wound.
  std::vector<Triangle> visibleTriangles(float open) const;
};

}  // namespace softscope
