// eval/simulation/texture/tissue_texture.cpp: serosa with lobules, fat, capillaries and vessels.
#include "eval/simulation/texture/tissue_texture.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/simulation/noise/noise.h"
#include "eval/simulation/texture/texture_settings.h"

namespace softscope {
namespace {

// Linear colours, selected by comparison with images of the abdomen.
const Eigen::Vector3f kDeepRed(0.38F, 0.062F, 0.050F);
const Eigen::Vector3f kPink(0.62F, 0.200F, 0.165F);
const Eigen::Vector3f kFascia(0.70F, 0.36F, 0.30F);
const Eigen::Vector3f kFat(0.76F, 0.36F, 0.110F);
const Eigen::Vector3f kPaleFat(0.82F, 0.49F, 0.20F);
const Eigen::Vector3f kBlood(0.40F, 0.022F, 0.024F);
const Eigen::Vector3f kFreshBlood(0.21F, 0.010F, 0.009F);
const Eigen::Vector3f kFlesh(0.42F, 0.055F, 0.042F);
const Eigen::Vector3f kPooledBlood(0.085F, 0.005F, 0.005F);
const Eigen::Vector3f kVein(0.24F, 0.055F, 0.085F);
const Eigen::Vector3f kMean(0.60F, 0.23F, 0.17F);

constexpr float kSkin_mm = 0.6F;    // visible thickness at a wound lip
constexpr float kBloody_mm = 2.7F;  // depth of blood in a wound
constexpr float kLobule_mm = 1.0F;
constexpr float kFatLobule_mm = 2.6F;

Eigen::Vector3f mix(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float share) {
  const float t = std::clamp(share, 0.0F, 1.0F);
  return {a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()), a.z() + t * (b.z() - a.z())};
}

VesselOptions noVessels() {
  VesselOptions none;
  none.trunk_radius_mm = 0;
  return none;
}

}  // namespace

void TextureOptions::validate() const {
  requireAllowed(*this);
  require(picture.empty() || picture_mm <= picture.width_px, "texture.picture_mm", picture_mm,
          "must be no more than the image has pixels across: coarser ones than 1 mm are a blur");
}

TissueTexture::TissueTexture(const TriangleMesh& rest_mesh, const TextureOptions& options,
                             std::uint64_t seed, std::optional<PictureTexture> picture)
    : options_(options),
      seed_(static_cast<std::uint32_t>(seed)),
      picture_(std::move(picture)),
      mean_(picture_ ? picture_->mean() : kMean),
      vessels_(growVessels(rest_mesh, picture_ ? noVessels() : options.vessels, seed)) {
  options.validate();
  options_.picture = {};  // moved into `picture_`
}

TissueTexture::Layer TissueTexture::serosa(const Eigen::Vector3f& warped_mm,
                                           const Eigen::Vector3f& rest_mm) const {
  const float broad = fractalNoise(rest_mm / 13, 3, seed_ + 1);
  const float middle = fractalNoise(warped_mm / 3.2F, 3, seed_ + 2);
  const float fine = fractalNoise(rest_mm / 0.55F, 2, seed_ + 3);
  const CellularNoise lobule = cellularNoise(warped_mm / kLobule_mm, seed_ + 4);
  const float wall = 1 - smoothStep(0.0F, 0.26F, lobule.second - lobule.nearest);
  const float tint = float(lobule.id >> 8) * 0x1p-24F - 0.5F;
  const float lobulated = smoothStep(-0.25F, 0.3F, smoothNoise(rest_mm / 9, seed_ + 5));

  Eigen::Vector3f albedo = mix(kDeepRed, kPink, 0.62F + 1.1F * broad + 0.55F * middle);
  albedo = mix(albedo, kFascia, 0.8F * smoothStep(0.08F, 0.45F, middle + 0.6F * broad));
  albedo *= 1 + 0.22F * fine + lobulated * 0.22F * tint;
  albedo = mix(albedo, kFascia, 0.24F * wall * lobulated);
  const float relief_mm = 0.045F * fine + 0.16F * middle + 0.06F * lobulated * (1 - wall);
  return {albedo, relief_mm};
}

TissueTexture::Layer TissueTexture::fat(const Eigen::Vector3f& warped_mm) const {
  const CellularNoise lobule = cellularNoise(warped_mm / kFatLobule_mm, seed_ + 6);
  const float groove = 1 - smoothStep(0.0F, 0.25F, lobule.second - lobule.nearest);
  const float tint = float(lobule.id >> 8) * 0x1p-24F;
  const float grain = fractalNoise(warped_mm / 0.8F, 2, seed_ + 7);
  Eigen::Vector3f albedo = mix(kFat, kPaleFat, tint + 0.6F * grain);
  albedo = mix(albedo, kPink, 0.45F * groove) * (1 + 0.10F * grain);
  return {albedo, 0.35F * (0.9F - lobule.nearest) + 0.03F * grain};
}

float TissueTexture::fatShare(const Eigen::Vector3f& warped_mm) const {
  const float where = fractalNoise(warped_mm / 15, 3, seed_ + 8);
  const float level = 0.34F - 0.68F * float(options_.fat);  // noise rarely exceeds +-0.4
  return options_.fat == 0 ? 0 : smoothStep(level - 0.04F, level + 0.13F, where);
}

/// Network of fine lines: zero crossings of smooth noise.
float TissueTexture::capillaries(const Eigen::Vector3f& warped_mm) const {
  const float net = std::abs(smoothNoise(warped_mm / 1.1F, seed_ + 9));
  const float fine_net = std::abs(smoothNoise(warped_mm / 0.6F, seed_ + 10));
  const float where = smoothStep(-0.1F, 0.35F, smoothNoise(warped_mm / 5, seed_ + 11));
  return where *
         std::max(1 - smoothStep(0.0F, 0.09F, net), 0.6F * (1 - smoothStep(0.0F, 0.11F, fine_net)));
}

void TissueTexture::addVessels(Layer& layer, const Eigen::Vector3f& rest_mm) const {
  const VesselCover cover = vessels_.coverAt(rest_mm);
  layer.albedo = mix(layer.albedo, kVein, 0.62F * cover.vein);
  layer.albedo = mix(layer.albedo, kBlood, 0.72F * cover.artery);
  layer.relief_mm += cover.raised_mm;
}

float TissueTexture::bloodShare(const Eigen::Vector3f& warped_mm) const {
  if (options_.blood == 0) return 0;
  const float where = fractalNoise(warped_mm / 11, 4, seed_ + 14);
  const float level = 0.34F - 0.68F * float(options_.blood);  // as for fat
  return smoothStep(level, level + 0.05F, where);
}

/// Tissue below the skin: redder, bloodier and darker with depth, as less light reaches it.
TissueTexture::Layer TissueTexture::flesh(const Eigen::Vector3f& rest_mm, float depth_mm) const {
  const float grain = fractalNoise(rest_mm / 1.3F, 3, seed_ + 15);
  const float fine = fractalNoise(rest_mm / 0.4F, 2, seed_ + 16);
  const float deep = 1 - std::exp(-depth_mm / kBloody_mm);
  const Eigen::Vector3f albedo = mix(kFlesh, kFascia, 0.12F + 0.8F * grain) * (1 + 0.35F * fine);
  return {mix(albedo, kPooledBlood, 0.2F + 0.75F * deep), 0.05F * fine + 0.25F * grain};
}

TissueTexture::Layer TissueTexture::procedural(const Eigen::Vector3f& warped_mm,
                                               const Eigen::Vector3f& rest_mm) const {
  Layer layer = serosa(warped_mm, rest_mm);
  if (const float share = fatShare(warped_mm); share > 0) {
    const Layer over = fat(warped_mm);
    layer.albedo = mix(layer.albedo, over.albedo, 0.80F * share);
    layer.relief_mm += share * (over.relief_mm + 0.1F - layer.relief_mm);
  }
  layer.albedo = mix(layer.albedo, kBlood, 0.42F * capillaries(warped_mm));
  addVessels(layer, rest_mm);
  return layer;
}

/// The image has no relief; additional bumps break up the highlights.
TissueTexture::Layer TissueTexture::pictured(const Eigen::Vector3f& rest_mm,
                                             const Eigen::Vector3f& rest_normal) const {
  const float middle = fractalNoise(rest_mm / 3.2F, 3, seed_ + 2);
  const float fine = fractalNoise(rest_mm / 0.55F, 2, seed_ + 3);
  return {picture_->at(rest_mm, rest_normal), 0.04F * fine + 0.12F * middle};
}

TissuePoint TissueTexture::at(const Eigen::Vector3f& rest_mm, const Eigen::Vector3f& rest_normal,
                              float depth_mm) const {
  const Eigen::Vector3f warped_mm = rest_mm + 1.1F * vectorNoise(rest_mm / 4, seed_ + 12);
  Layer layer = picture_ ? pictured(rest_mm, rest_normal) : procedural(warped_mm, rest_mm);
  const float blood = bloodShare(warped_mm);
  layer.albedo = mix(layer.albedo, kFreshBlood, 0.93F * blood);
  layer.relief_mm *= 1 - 0.7F * blood;  // blood fills fine structures
  const float inside = smoothStep(0, kSkin_mm, depth_mm);
  if (inside > 0) {
    const Layer under = flesh(rest_mm, depth_mm);
    layer.albedo = mix(layer.albedo, under.albedo, inside);
    layer.relief_mm += inside * (under.relief_mm - layer.relief_mm);
  }
  const float wet = 0.55F + 0.45F * fractalNoise(rest_mm / 7, 2, seed_ + 13) * 2;
  TissuePoint point;
  point.albedo = mean_ + float(options_.contrast) * (layer.albedo - mean_);
  point.albedo = point.albedo.cwiseMax(0.005F).cwiseMin(0.95F);
  point.relief_mm = layer.relief_mm;
  point.wetness =
      float(options_.wetness) * std::clamp(wet + blood + inside, 0.1F, 1.0F + blood + inside);
  return point;
}

}  // namespace softscope
