// eval/simulation/texture/tissue_texture.h: procedural tissue colour per surface point.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/image.h"
#include "core/triangle_mesh.h"
#include "eval/simulation/texture/picture_texture.h"
#include "eval/simulation/texture/vessel_map.h"

namespace softscope {

struct TextureOptions {
  double contrast = 1.0;  // 0: uniform colour, 1: as in a healthy abdomen
  double fat = 0.3;       // approximate share of the surface covered by fat
  double wetness = 1.0;   // strength of highlights; 0: matt
  double blood = 0;       // approximate share of the surface covered by fresh blood
  VesselOptions vessels;
  ColourImage picture;     // empty: procedural tissue; else it replaces tissue, fat and vessels
  double picture_mm = 50;  // width on the tissue

  /// Throws OptionError.
  void validate() const;
};

/// One point of the tissue.
struct TissuePoint {
  Eigen::Vector3f albedo =
      Eigen::Vector3f::Zero();  // linear red, green, blue: share of reflected light
  float relief_mm = 0;          // fine bumps below the mesh resolution, for highlights
  float wetness = 0;
};

/// Solid texture: a function of the position in the undeformed tissue, so it
/// moves with the tissue. An image also depends on the normal of the surface.
class TissueTexture {
 public:
  /// `picture`: replaces procedural tissue.
  TissueTexture(const TriangleMesh& rest_mesh, const TextureOptions& options, std::uint64_t seed,
                std::optional<PictureTexture> picture = std::nullopt);

  /// `depth_mm`: depth below the skin inside a cut; 0: skin.
  TissuePoint at(const Eigen::Vector3f& rest_mm, const Eigen::Vector3f& rest_normal,
                 float depth_mm = 0) const;

 private:
  struct Layer {
    Eigen::Vector3f albedo;
    float relief_mm;
  };
  Layer procedural(const Eigen::Vector3f& warped_mm, const Eigen::Vector3f& rest_mm) const;
  Layer pictured(const Eigen::Vector3f& rest_mm, const Eigen::Vector3f& rest_normal) const;
  Layer flesh(const Eigen::Vector3f& rest_mm, float depth_mm) const;
  Layer serosa(const Eigen::Vector3f& warped_mm, const Eigen::Vector3f& rest_mm) const;
  Layer fat(const Eigen::Vector3f& warped_mm) const;
  float fatShare(const Eigen::Vector3f& warped_mm) const;
  float bloodShare(const Eigen::Vector3f& warped_mm) const;
  float capillaries(const Eigen::Vector3f& warped_mm) const;
  void addVessels(Layer& layer, const Eigen::Vector3f& rest_mm) const;

  TextureOptions options_;
  std::uint32_t seed_;
  std::optional<PictureTexture> picture_;
  Eigen::Vector3f mean_;  // reference of the contrast
  VesselMap vessels_;
};

}  // namespace softscope
