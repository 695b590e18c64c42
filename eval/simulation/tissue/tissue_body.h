// eval/simulation/tissue/tissue_body.h: the simulated organ: the surface of the tissue and the
// walls of a wound.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// A place on a triangle of the organ, or on one of its edges or vertices (the other shares are 0).
struct OrganPlace {
  std::array<std::int32_t, 3> vertices;
  Eigen::Vector3f shares;  // sum 1

  Eigen::Vector3f mixed(const std::vector<Eigen::Vector3f>& values) const {
    return shares[0] * values[vertices[0]] + shares[1] * values[vertices[1]] +
           shares[2] * values[vertices[2]];
  }
};

/// What the organ became when it was cut, before anything moved: its triangles split along the
/// cut, whose lips lie on each other, and walls between the lips. Closed where the organ was.
struct TissueBody {
  TriangleMesh organ;              // as it was; its vertices are the first of `mesh`
  TriangleMesh mesh;               // at rest: `skin` triangles first, then the walls
  std::size_t skin_triangles = 0;  // of mesh
  // One a vertex of `mesh`; all empty where nothing was cut.
  std::vector<OrganPlace> places;         // that it moves with: a wall's is at its lip
  std::vector<float> depth_mm;            // 0: skin; else of a wall, below its lip
  std::vector<Eigen::Vector3f> below_mm;  // from its place, at rest
  std::vector<Eigen::Vector3f> gape_mm;   // how far the open wound moves it

  static TissueBody whole(TriangleMesh organ);

  /// `open`: 0 closed, 1 as wide as it gets. `organ_mm`: where the organ's vertices are now.
  std::vector<Eigen::Vector3f> verticesAt(const std::vector<Eigen::Vector3f>& organ_mm,
                                          float open) const;

  /// Normals of `vertices_mm`, as verticesAt() gives them in any frame; unit length, or as long as
  /// interpolation makes them. The skin's are those of the organ's own triangles, as if the wound
  /// were bridged: a closed one changes nothing.
  std::vector<Eigen::Vector3f> normalsOf(const std::vector<Eigen::Vector3f>& vertices_mm) const;

  /// What a ray can meet: walls that lie on each other, no ray tells apart.
  std::vector<Triangle> visibleTriangles(float open) const;
};

}  // namespace softscope
