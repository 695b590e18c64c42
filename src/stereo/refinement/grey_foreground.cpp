#include "stereo/refinement/grey_foreground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/mask_morphology.h"
#include "core/median.h"
#include "core/parallel.h"
#include "core/redness.h"

namespace softscope {
namespace {

constexpr int kBlocksPerRow = 80;
constexpr int kLeastBlockPx = 4;
constexpr float kLeastBrightness = 25;  // mean of the channels; darker has no colour
constexpr float kLeastRedness = 0.04F;  // of red blocks
constexpr double kLeastRedShare = 0.1;  // of the lit blocks
constexpr float kGreyShare = 0.25F;     // of the red blocks' median redness
constexpr float kTissueShare = 0.5F;    // the same
constexpr int kTissueMargin = 2;        // blocks: at a contour, depth and colour are mixed
constexpr float kSteepest = 2.75F;      // depth over width: 70 degrees

/// Means over a square of pixels.
struct Block {
  float brightness = 0;
  float redness = 0;
  float depth_mm = 0;
  float nearest_mm = std::numeric_limits<float>::infinity(), farthest_mm = 0;
  int measured = 0;
};

class Blocks {
 public:
  Blocks(const ColourImage& left, const Raster<float>& depth_mm, const PinholeCamera& camera)
      : block_px_(std::max(kLeastBlockPx, (left.width_px + kBlocksPerRow / 2) / kBlocksPerRow)),
        steepest_(kSteepest * static_cast<float>(block_px_ / camera.fx_px)),
        blocks_((left.width_px + block_px_ - 1) / block_px_,
                (left.height_px + block_px_ - 1) / block_px_) {
    parallelRanges(blocks_.height_px, 4, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < blocks_.width_px; ++x) blocks_.at(x, y) = meanOf(left, depth_mm, x, y);
    });
  }

  /// Empty: none is.
  Mask apart() const {
    const float redness = tissueRedness();
    if (!(redness > 0)) return {};
    const Mask tissue = connected(interior(redness * kTissueShare), Mask());
    const Raster<float> tissue_mm = depthOfNearest(tissue);
    Mask grey(blocks_.width_px, blocks_.height_px, 0);
    bool any = false;
    for (std::size_t i = 0; i < grey.size(); ++i) {
      const Block& block = blocks_.values[i];
      grey.values[i] = isLit(block) && block.measured > 0 && tissue.values[i] == 0 &&
                       block.redness < redness * kGreyShare && block.depth_mm < tissue_mm.values[i];
      any = any || grey.values[i] != 0;
    }
    return any ? connected(std::move(grey), tissue) : Mask();
  }

  /// Pixels of these blocks, and pixels beside them at their depth: blocks at a contour are mixed.
  Mask pixelsOf(const Mask& apart, const Raster<float>& depth_mm) const {
    const Mask beside = dilated(apart, 1);
    Mask pixels(depth_mm.width_px, depth_mm.height_px, 0);
    parallelRows(pixels.height_px, [&](int v) {
      for (int u = 0; u < pixels.width_px; ++u) {
        const int x = u / block_px_, y = v / block_px_;
        if (beside.at(x, y) != 0)
          pixels.at(u, v) = apart.at(x, y) != 0 || liesOnAny(apart, x, y, depth_mm.at(u, v));
      }
    });
    return pixels;
  }

 private:
  static bool isLit(const Block& block) { return block.brightness >= kLeastBrightness; }

  Block meanOf(const ColourImage& left, const Raster<float>& depth_mm, int x, int y) const {
    int red = 0, all = 0;
    Block block;
    const int u_end = std::min((x + 1) * block_px_, left.width_px);
    const int v_end = std::min((y + 1) * block_px_, left.height_px);
    for (int v = y * block_px_; v < v_end; ++v)
      for (int u = x * block_px_; u < u_end; ++u) {
        const Rgb8& pixel = left.at(u, v);
        red += pixel.red;
        all += pixel.red + pixel.green + pixel.blue;
        const float here_mm = depth_mm.at(u, v);
        if (!std::isfinite(here_mm)) continue;
        block.depth_mm += here_mm;
        block.nearest_mm = std::min(block.nearest_mm, here_mm);
        block.farthest_mm = std::max(block.farthest_mm, here_mm);
        ++block.measured;
      }
    const int pixels = (u_end - x * block_px_) * (v_end - y * block_px_);
    block.brightness = static_cast<float>(all) / static_cast<float>(3 * pixels);
    block.redness = redness(red, all);
    if (block.measured > 0) block.depth_mm /= static_cast<float>(block.measured);
    return block;
  }

  bool liesOnAny(const Mask& apart, int x, int y, float pixel_mm) const {
    bool lies = false;
    forEachNeighbour(y * blocks_.width_px + x, [&](int beside) {
      const float block_mm = blocks_.values[beside].depth_mm;
      lies = lies ||
             (apart.values[beside] != 0 && std::abs(pixel_mm - block_mm) <= steepest_ * block_mm);
    });
    return lies;
  }

  /// Median of the red blocks; 0 if they are few.
  float tissueRedness() const {
    std::vector<float> red;
    int lit = 0;
    for (const Block& block : blocks_.values) {
      if (!isLit(block)) continue;
      ++lit;
      if (block.redness > kLeastRedness) red.push_back(block.redness);
    }
    const bool few = static_cast<double>(red.size()) <= kLeastRedShare * lit;
    return few ? 0 : medianOf(std::move(red));
  }

  /// Measured blocks with more than this redness, in a square of such blocks.
  Mask interior(float redness) const {
    Mask red(blocks_.width_px, blocks_.height_px, 0);
    for (std::size_t i = 0; i < red.size(); ++i)
      red.values[i] = isLit(blocks_.values[i]) && blocks_.values[i].redness >= redness;
    Mask inside = eroded(red, kTissueMargin);
    for (std::size_t i = 0; i < inside.size(); ++i)
      if (blocks_.values[i].measured == 0) inside.values[i] = 0;
    return inside;
  }

  /// With the measured blocks that a path without steep steps joins to it, not through `closed`.
  Mask connected(Mask region, const Mask& closed) const {
    std::vector<int> front;
    for (std::size_t i = 0; i < region.size(); ++i)
      if (region.values[i] != 0) front.push_back(static_cast<int>(i));
    while (!front.empty()) {
      const int from = front.back();
      front.pop_back();
      forEachNeighbour(from, [&](int to) {
        if (region.values[to] != 0 || (!closed.empty() && closed.values[to] != 0)) return;
        if (!joined(blocks_.values[from], blocks_.values[to])) return;
        region.values[to] = 1;
        front.push_back(to);
      });
    }
    return region;
  }

  /// Of the block of `tissue` that is the fewest steps away; 0 without any.
  Raster<float> depthOfNearest(const Mask& tissue) const {
    Raster<float> depth_mm(tissue.width_px, tissue.height_px, 0.0F);
    std::vector<int> ring, next;
    for (std::size_t i = 0; i < tissue.size(); ++i) {
      if (tissue.values[i] == 0) continue;
      depth_mm.values[i] = blocks_.values[i].depth_mm;
      ring.push_back(static_cast<int>(i));
    }
    for (; !ring.empty(); ring.swap(next), next.clear())
      for (const int from : ring)
        forEachNeighbour(from, [&](int to) {
          if (depth_mm.values[to] > 0) return;
          depth_mm.values[to] = depth_mm.values[from];
          next.push_back(to);
        });
    return depth_mm;
  }

  template <class Visit>
  void forEachNeighbour(int block, const Visit& visit) const {
    const int x = block % blocks_.width_px, y = block / blocks_.width_px;
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u)
        if (blocks_.contains(u, v)) visit(v * blocks_.width_px + u);
  }

  bool joined(const Block& a, const Block& b) const {
    return isOneSurface(b) &&
           std::abs(a.depth_mm - b.depth_mm) <= steepest_ * std::min(a.depth_mm, b.depth_mm);
  }
  /// Its corners are further apart than its neighbours' middles.
  bool isOneSurface(const Block& block) const {
    return block.measured > 0 &&
           block.farthest_mm - block.nearest_mm <= 2 * steepest_ * block.nearest_mm;
  }

  int block_px_;
  float steepest_;  // step from block to block, as a share of the depth
  Raster<Block> blocks_;
};

}  // namespace

Mask greyForeground(const ColourImage& left, const Raster<float>& depth_mm,
                    const PinholeCamera& camera) {
  if (!left.sameShape(depth_mm)) throw Error("an image of another size than the depths");
  const Blocks blocks(left, depth_mm, camera);
  const Mask apart = blocks.apart();
  return apart.empty() ? Mask() : blocks.pixelsOf(apart, depth_mm);
}

}  // namespace softscope
