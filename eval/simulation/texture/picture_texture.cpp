// eval/simulation/texture/picture_texture.cpp: three mirrored projections of one downsampled image.
#include "eval/simulation/texture/picture_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softscope {
namespace {

using Linear = Raster<Eigen::Vector3f>;

constexpr int kMostSidePx = 4096;
constexpr float kFront = 1.7F;  // the frontal projection covers slopes of up to about 60 degrees

/// Inverse of sRGB (IEC 61966-2-1).
std::array<float, 256> linearValues() {
  std::array<float, 256> values{};
  for (int i = 0; i < 256; ++i) {
    const double x = i / 255.0;
    values[i] = static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
  }
  return values;
}

/// Mean of blocks of `cells` x `cells`; incomplete blocks at the right and bottom are dropped.
Linear averaged(const ColourImage& picture, int cells) {
  static const std::array<float, 256> kLinear = linearValues();
  Linear result(picture.width_px / cells, picture.height_px / cells, Eigen::Vector3f::Zero());
  for (int v = 0; v < result.height_px * cells; ++v)
    for (int u = 0; u < result.width_px * cells; ++u) {
      const Rgb8& pixel = picture.at(u, v);
      result.at(u / cells, v / cells) +=
          Eigen::Vector3f(kLinear[pixel.red], kLinear[pixel.green], kLinear[pixel.blue]);
    }
  for (Eigen::Vector3f& value : result.values) value /= float(cells * cells);
  return result;
}

int cellsOf(const ColourImage& picture, double pixel_mm, double texel_mm) {
  const int shorter_px = std::min(picture.width_px, picture.height_px);
  const int longer_px = std::max(picture.width_px, picture.height_px);
  const int wanted = std::max(static_cast<int>(std::min(texel_mm / pixel_mm, 1e6)),
                              (longer_px + kMostSidePx - 1) / kMostSidePx);
  return std::clamp(wanted, 1, shorter_px);
}

/// Mirrored coordinate in [0, side].
float mirrored(float x, float side) {
  const float turn = std::fmod(std::abs(x), 2 * side);
  return turn > side ? 2 * side - turn : turn;
}

}  // namespace

PictureTexture::PictureTexture(const ColourImage& picture, double picture_mm, double texel_mm,
                               const Eigen::Isometry3d& body_from_view)
    : view_from_body_(body_from_view.inverse().cast<float>()) {
  const double pixel_mm = picture_mm / picture.width_px;
  const int cells = cellsOf(picture, pixel_mm, texel_mm);
  linear_ = averaged(picture, cells);
  pixel_mm_ = static_cast<float>(cells * pixel_mm);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& value : linear_.values) sum += value.cast<double>();
  mean_ = (sum / double(linear_.size())).cast<float>();
}

/// Bilinear interpolation, relative to the image centre.
Eigen::Vector3f PictureTexture::pixelAt(float right_mm, float down_mm) const {
  const auto width = float(linear_.width_px), height = float(linear_.height_px);
  const float x =
      std::clamp(mirrored(right_mm / pixel_mm_ + 0.5F * width, width) - 0.5F, 0.0F, width - 1);
  const float y =
      std::clamp(mirrored(down_mm / pixel_mm_ + 0.5F * height, height) - 0.5F, 0.0F, height - 1);
  const int u = static_cast<int>(x), v = static_cast<int>(y);
  const int right = std::min(u + 1, linear_.width_px - 1),
            below = std::min(v + 1, linear_.height_px - 1);
  const float fx = x - float(u), fy = y - float(v);
  return (1 - fy) * ((1 - fx) * linear_.at(u, v) + fx * linear_.at(right, v)) +
         fy * ((1 - fx) * linear_.at(u, below) + fx * linear_.at(right, below));
}

Eigen::Vector3f PictureTexture::at(const Eigen::Vector3f& rest_mm,
                                   const Eigen::Vector3f& normal) const {
  const Eigen::Vector3f p = view_from_body_ * rest_mm;
  Eigen::Array3f share = (view_from_body_.linear() * normal).array().abs();
  share.z() = std::max(kFront * share.z(), 1e-3F);  // also for an unknown normal
  share = share.square().square().square();
  share /= share.sum();
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();
  if (share.x() > 0.004F) colour += share.x() * pixelAt(p.z(), p.y());
  if (share.y() > 0.004F) colour += share.y() * pixelAt(p.x(), p.z());
  if (share.z() > 0.004F) colour += share.z() * pixelAt(p.x(), p.y());
  return colour;
}

}  // namespace softscope
