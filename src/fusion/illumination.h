// src/fusion/illumination.h: brightness as the tissue's own, and as the scope's light makes it.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/hd.h"
#include "core/image.h"
#include "fusion/fusion_options.h"

namespace softscope {

/// Encoded brightness of a surface under the scope's light over that of the same surface head on
/// at the reference distance: docs/fusion.md (F12). Bounded to 1/4 … 4.
/// distance_mm: from the scope; cosine: between the normal and the way to the scope.
SOFTSCOPE_HD inline float shading(float distance_mm, float cosine, float reference_distance_mm,
                                  float gamma) {
  const float least_cosine = 0.2f;
  const float ratio = reference_distance_mm / distance_mm;
  const float lit = ratio * ratio * (cosine > least_cosine ? cosine : least_cosine);
  const float encoded = std::pow(lit, 1 / gamma);
  if (!(encoded > 0.25f)) return 0.25f;
  return encoded < 4 ? encoded : 4.0f;
}

/// (F12) by the options: 1 where colours are kept as seen.
SOFTSCOPE_HD inline float shading(const ColourOptions& options, float distance_mm, float cosine) {
  if (options.illumination == Illumination::kNone) return 1;
  return shading(distance_mm, cosine, static_cast<float>(options.reference_distance_mm),
                 static_cast<float>(options.gamma));
}

SOFTSCOPE_HD inline std::uint8_t toByte(float level) {
  return static_cast<std::uint8_t>(level >= 254.5f ? 255.0f : (level > 0 ? level + 0.5f : 0.0f));
}

/// Every channel times its factor: picture = albedo times shading times gain, and back.
SOFTSCOPE_HD inline Rgb8 scaled(Rgb8 colour, float red, float green, float blue) {
  return {toByte(static_cast<float>(colour.red) * red),
          toByte(static_cast<float>(colour.green) * green),
          toByte(static_cast<float>(colour.blue) * blue)};
}

/// A point's colour as the scope would see it: what the model view draws under a headlight.
SOFTSCOPE_HD inline Rgb8 relit(Rgb8 albedo, float shade) {
  return scaled(albedo, shade, shade, shade);
}

}  // namespace softscope
