#include "stereo/disparity_filter.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "stereo/spread.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Disjoint sets of pixels, joined by union, found with path halving.
class Islands {
 public:
  explicit Islands(std::size_t pixels) : parent_(pixels), size_(pixels, 1) {
    for (std::size_t i = 0; i < pixels; ++i) parent_[i] = static_cast<int>(i);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
  }
  int sizeOf(int i) { return size_[root(i)]; }

 private:
  std::vector<int> parent_, size_;
};

/// Fills the gaps of one line of `count` values that lie `stride` apart.
void fillLine(float* line, int count, std::size_t stride, int width, float step) {
  int last = -1;  // last measured position
  for (int i = 0; i < count; ++i) {
    const float here = line[i * stride];
    if (std::isnan(here)) continue;
    const int gap = i - last - 1;
    if (last >= 0 && gap > 0 && gap <= width) {
      const float before = line[last * stride];
      if (std::abs(here - before) <= step)
        for (int k = 1; k <= gap; ++k)
          line[(last + k) * stride] =
              before + (here - before) * static_cast<float>(k) / static_cast<float>(gap + 1);
    }
    last = i;
  }
}

/// True where a step of more than `step` lies between the pixel and its right or lower neighbour.
bool isEdge(const Raster<float>& d, int u, int v, float step) {
  const float here = d.at(u, v);
  return (u + 1 < d.width_px && std::abs(d.at(u + 1, v) - here) > step) ||
         (v + 1 < d.height_px && std::abs(d.at(u, v + 1) - here) > step);
}

}  // namespace

Raster<float> checkLeftRight(const Raster<std::int16_t>& left, const Raster<std::int16_t>& right,
                             int tolerance_px) {
  Raster<float> checked(left.width_px, left.height_px, kNaN);
  parallelRows(left.height_px, [&](int v) {
    for (int u = 0; u < left.width_px; ++u) {
      const int d = left.at(u, v);
      if (d < 0 || u - d < 0) continue;
      const int back = right.at(u - d, v);
      if (back >= 0 && std::abs(back - d) <= tolerance_px) checked.at(u, v) = static_cast<float>(d);
    }
  });
  return checked;
}

void removeDark(Raster<float>& disparity_px, const GrayImage& left, int darkest_gray,
                int margin_px) {
  Raster<std::uint8_t> dark(left.width_px, left.height_px, 0);
  parallelRows(left.height_px, [&](int v) {
    for (int u = 0; u < left.width_px; ++u) dark.at(u, v) = left.at(u, v) < darkest_gray;
  });
  const Raster<std::uint8_t> near_dark = spread(dark, margin_px);
  for (std::size_t i = 0; i < disparity_px.size(); ++i)
    if (near_dark.values[i] != 0) disparity_px.values[i] = kNaN;
}

void removeSpeckles(Raster<float>& disparity_px, int size_px, double step_px) {
  const int width = disparity_px.width_px, height = disparity_px.height_px;
  const float step = static_cast<float>(step_px);
  const float* d = disparity_px.values.data();
  Islands islands(disparity_px.size());
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const int i = v * width + u;
      if (u + 1 < width && std::abs(d[i] - d[i + 1]) <= step) islands.join(i, i + 1);
      if (v + 1 < height && std::abs(d[i] - d[i + width]) <= step) islands.join(i, i + width);
    }
  for (int i = 0; i < width * height; ++i)
    if (islands.sizeOf(i) < size_px) disparity_px.values[i] = kNaN;
}

void fillGaps(Raster<float>& disparity_px, int width_px, double step_px) {
  const int width = disparity_px.width_px, height = disparity_px.height_px;
  const float step = static_cast<float>(step_px);
  parallelRows(height, [&](int v) { fillLine(disparity_px.row(v), width, 1, width_px, step); });
  parallelRanges(width, 64, [&](int begin, int end) {
    for (int u = begin; u < end; ++u)
      fillLine(disparity_px.values.data() + u, height, static_cast<std::size_t>(width), width_px,
               step);
  });
}

void erodeEdges(DisparityMap& map, int reach_px, double step_px, int border_px) {
  const Raster<float> before = map.disparity_px;
  const int width = before.width_px, height = before.height_px;
  const auto remove = [&](int u, int v) {
    if (before.contains(u, v)) map.disparity_px.at(u, v) = map.sigma_px.at(u, v) = kNaN;
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      if (u < border_px || v < border_px || u >= width - border_px || v >= height - border_px)
        remove(u, v);
      if (reach_px <= 0 || !isEdge(before, u, v, static_cast<float>(step_px))) continue;
      for (int dv = 1 - reach_px; dv <= reach_px; ++dv)
        for (int du = 1 - reach_px; du <= reach_px; ++du) remove(u + du, v + dv);
    }
}

}  // namespace softscope
