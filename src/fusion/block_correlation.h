// src/fusion/block_correlation.h: correlation of the model's brightness with the image's in one
// block of the image, in place and moved: docs/fusion.md (F26).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/hd.h"
#include "core/image.h"

namespace softscope {

/// Sums over the points of one block in device counters. Sufficient for blocks of 256 x 256 pixels.
struct BlockSums {
  static constexpr int kPlaces = 9;
  struct Place {
    std::uint32_t image, image_sq, product;
  };
  std::uint32_t points, model, model_sq;
  Place places[kPlaces];
};

/// Sums over the points of one block. They are integers, so their order is irrelevant.
class BlockCorrelation {
 public:
  BlockCorrelation() = default;
  explicit BlockCorrelation(const BlockSums& sums)
      : points_(static_cast<int>(sums.points)), model_(sums.model), model_sq_(sums.model_sq) {
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const BlockSums::Place& from = sums.places[k];
      places_[k] = {double(from.image), double(from.image_sq), double(from.product)};
    }
  }

  static int blockPx(int width_px) { return std::max(16, width_px / 20); }  // 32 px of 640
  static constexpr int kPlaces = BlockSums::kPlaces;  // in place, and moved in eight directions

  /// -1, 0 or 1: position among the 3 x 3.
  SOFTSCOPE_HD static int column(int place) { return place % 3 - 1; }
  SOFTSCOPE_HD static int row(int place) { return place / 3 - 1; }

  /// Adds a point of `brightness` at a pixel of the image, in place and moved by `shift_px`
  /// (the same for all points of the block); skipped if a moved position is outside.
  void add(double brightness, const ColourImage& image, int u, int v, int shift_px) {
    if (u < shift_px || v < shift_px || u + shift_px >= image.width_px ||
        v + shift_px >= image.height_px)
      return;
    ++points_;
    model_ += brightness;
    model_sq_ += brightness * brightness;
    for (int place = 0; place < kPlaces; ++place) {
      const double seen = toGray(image.at(u + shift_px * column(place), v + shift_px * row(place)));
      Place& sums = places_[static_cast<std::size_t>(place)];
      sums.image += seen;
      sums.image_sq += seen * seen;
      sums.product += brightness * seen;
    }
  }

  void operator+=(const BlockCorrelation& other) {
    points_ += other.points_;
    model_ += other.model_;
    model_sq_ += other.model_sq_;
    for (std::size_t k = 0; k < kPlaces; ++k) {
      places_[k].image += other.places_[k].image;
      places_[k].image_sq += other.places_[k].image_sq;
      places_[k].product += other.places_[k].product;
    }
  }

  int points() const { return points_; }
  bool hasEnoughPoints() const { return points_ >= kFewestPoints; }
  bool textured() const {
    return hasEnoughPoints() &&
           model_sq_ / points_ - std::pow(model_ / points_, 2) > kLeastVariance;
  }
  /// At the position with the highest correlation.
  double bestCorrelation() const {
    double best = correlationAt(0);
    for (int place = 1; place < kPlaces; ++place) best = std::max(best, correlationAt(place));
    return best;
  }
  /// Whether the correlation is highest in place.
  bool bestInPlace() const {
    const double here = correlationAt(kInPlace);
    for (int place = 0; place < kPlaces; ++place)
      if (place != kInPlace && !(here > correlationAt(place))) return false;
    return here > 0;
  }

 private:
  static constexpr int kInPlace = 4;           // of 3 x 3 places, row by row
  static constexpr int kFewestPoints = 40;     // of a block
  static constexpr double kLeastVariance = 4;  // twice the noise of a good camera
  struct Place {
    double image = 0, image_sq = 0, product = 0;
  };

  double correlationAt(int place) const {
    const Place& sums = places_[static_cast<std::size_t>(place)];
    const double covariance = sums.product - sums.image * model_ / points_;
    const double variance = (sums.image_sq - sums.image * sums.image / points_) *
                            (model_sq_ - model_ * model_ / points_);
    return variance > 0 ? covariance / std::sqrt(variance) : 0;
  }

  int points_ = 0;
  double model_ = 0, model_sq_ = 0;
  std::array<Place, kPlaces> places_;
};

}  // namespace softscope
