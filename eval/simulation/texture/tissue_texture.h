// eval/simulation/texture/tissue_texture.h: procedural colour of tissue at each surface point.
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
  double contrast = 1.0;  // 0: one colour all over, 1: as in a healthy abdomen
  double fat = 0.3;       // share of the surface that fat covers, roughly
  double wetness = 1.0;   // strength of highlights; 0: dull
  double blood = 0;       // share of the surface under fresh blood, roughly
  VesselOptions vessels;
  ColourImage picture;     // empty: procedural tissue; else it stands for that, fat and vessels
  double picture_mm = 50;  // its width on the tissue

  /// Throws OptionError.
  void validate() const;
};

/// One point of the tissue.
struct TissuePoint {
  Eigen::Vector3f albedo =
      Eigen::Vector3f::Zero();  // linear red, green, blue: share of light sent back
  float relief_mm = 0;          // fine bumps that bend highlights, too small for the mesh
  float wetness = 0;
};

/// A solid texture: a function of the place in the undeformed tissue, so that it moves with it. A
/// image also asks which way the surface faces there.
class TissueTexture {
 public:
  /// `picture`: instead of procedural tissue.
  TissueTexture(const TriangleMesh& rest_mesh, const TextureOptions& options, std::uint64_t seed,
                std::optional<PictureTexture> picture = std::nullopt);

  /// `depth_mm`: below the skin, where a cut lays the tissue open; 0: skin.
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
  Eigen::Vector3f mean_;  // that contrast is measured from
  VesselMap vessels_;
};

}  // namespace softscope
