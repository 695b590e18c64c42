#include "stereo/refinement/disparity_filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/mask_morphology.h"
#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope {
namespace {

/// Measured adjacent pixels of one row on one surface.
struct Run {
  int begin, end;  // columns
  int parent;      // run of the same island, itself at the root
  int island_px;   // of the root: pixels of the island
};

/// Runs joined to islands, found with path halving.
class Islands {
 public:
  explicit Islands(float step_px) : step_px_(step_px) {}

  void addRow(const float* d, int width) {
    above_ = row_;
    row_ = static_cast<int>(runs_.size());
    for (int u = 0; u < width; ++u) {
      if (std::isnan(d[u])) continue;
      const int begin = u;
      while (u + 1 < width && std::abs(d[u + 1] - d[u]) <= step_px_) ++u;
      const int index = static_cast<int>(runs_.size());
      runs_.push_back({begin, u + 1, index, u + 1 - begin});
    }
  }

  /// Joins the runs of the last row with adjacent ones above.
  void joinRows(const float* above, const float* row) {
    int a = above_, b = row_;
    while (a < row_ && b < static_cast<int>(runs_.size())) {
      const int begin = std::max(runs_[a].begin, runs_[b].begin);
      const int end = std::min(runs_[a].end, runs_[b].end);
      for (int u = begin; u < end; ++u)
        if (std::abs(above[u] - row[u]) <= step_px_) {
          join(a, b);
          break;
        }
      (runs_[a].end < runs_[b].end ? a : b) += 1;
    }
  }

  /// In raster order.
  const std::vector<Run>& runs() const { return runs_; }
  int sizeOf(int i) { return runs_[root(i)].island_px; }

 private:
  int root(int i) {
    while (runs_[i].parent != i) i = runs_[i].parent = runs_[runs_[i].parent].parent;
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (runs_[a].island_px < runs_[b].island_px) std::swap(a, b);
    runs_[b].parent = a;
    runs_[a].island_px += runs_[b].island_px;
  }

  float step_px_;
  std::vector<Run> runs_;
  int above_ = 0, row_ = 0;  // first runs of the last two rows
};

/// Fills the gaps of one line of `count` values with a distance of `stride`.
void fillLine(float* line, int count, std::size_t stride, int width, float step) {
  int last = -1;  // last measured position
  for (int i = 0; i < count; ++i) {
    const float here = line[i * stride];
    if (std::isnan(here)) continue;
    const int gap = i - last - 1;
    if (last >= 0 && gap > 0 && gap <= width) {
      const float before = line[last * stride];
      if (std::abs(here - before) <= step)
        for (int k = 1; k <= gap; ++k) line[(last + k) * stride] = gapValue(before, here, k, gap);
    }
    last = i;
  }
}

/// Marks pixels separated by a step of more than `step` from their right or lower neighbour.
Raster<std::uint8_t> findEdges(const Raster<float>& d, float step) {
  Raster<std::uint8_t> edges(d.width_px, d.height_px, 0);
  parallelRows(d.height_px, [&](int v) {
    const float *here = d.row(v), *below = d.row(std::min(v + 1, d.height_px - 1));
    std::uint8_t* edge = edges.row(v);
    const int last = d.width_px - 1;
    for (int u = 0; u < last; ++u) {
      const bool beside = std::abs(here[u + 1] - here[u]) > step;
      const bool beneath = std::abs(below[u] - here[u]) > step;
      edge[u] = beside || beneath;
    }
    edge[last] = std::abs(below[last] - here[last]) > step;
  });
  return edges;
}

void forget(DisparityMap& map, int v, int begin, int end) {
  for (int u = std::max(begin, 0); u < std::min(end, map.disparity_px.width_px); ++u)
    map.disparity_px.at(u, v) = map.sigma_px.at(u, v) = kNotMeasured<float>;
}

}  // namespace

Raster<float> checkLeftRight(const Raster<std::int16_t>& left, const Raster<std::int16_t>& right,
                             int tolerance_px) {
  Raster<float> checked(left.width_px, left.height_px, kNotMeasured<float>);
  parallelRows(left.height_px, [&](int v) {
    for (int u = 0; u < left.width_px; ++u) {
      const int d = left.at(u, v);
      if (d < 0 || u - d < 0) continue;
      if (confirmsDisparity(d, right.at(u - d, v), tolerance_px))
        checked.at(u, v) = static_cast<float>(d);
    }
  });
  return checked;
}

void removeDark(Raster<float>& disparity_px, const GrayImage& left, int darkest_gray,
                int margin_px) {
  const int width = left.width_px;
  Raster<std::uint8_t> dark(width, left.height_px, 0);
  parallelRows(left.height_px, [&](int v) {
    const std::uint8_t* gray = left.row(v);
    std::uint8_t* mark = dark.row(v);
    for (int u = 0; u < width; ++u) mark[u] = gray[u] < darkest_gray;
  });
  const Raster<std::uint8_t> near_dark = dilated(dark, margin_px);
  parallelRows(left.height_px, [&](int v) {
    const std::uint8_t* mark = near_dark.row(v);
    float* d = disparity_px.row(v);
    for (int u = 0; u < width; ++u) d[u] = mark[u] != 0 ? kNotMeasured<float> : d[u];
  });
}

void removeSpeckles(Raster<float>& disparity_px, int size_px, double step_px) {
  Islands islands(static_cast<float>(step_px));
  std::vector<int> ends;  // of the runs of each row
  for (int v = 0; v < disparity_px.height_px; ++v) {
    islands.addRow(disparity_px.row(v), disparity_px.width_px);
    if (v > 0) islands.joinRows(disparity_px.row(v - 1), disparity_px.row(v));
    ends.push_back(static_cast<int>(islands.runs().size()));
  }
  int i = 0;
  for (int v = 0; v < disparity_px.height_px; ++v)
    for (; i < ends[static_cast<std::size_t>(v)]; ++i)
      if (const Run& run = islands.runs()[static_cast<std::size_t>(i)]; islands.sizeOf(i) < size_px)
        std::fill(disparity_px.row(v) + run.begin, disparity_px.row(v) + run.end,
                  kNotMeasured<float>);
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
  const int width = map.disparity_px.width_px, height = map.disparity_px.height_px;
  const Raster<std::uint8_t> edges = findEdges(map.disparity_px, static_cast<float>(step_px));
  parallelRows(height, [&](int v) {
    if (v < border_px || v >= height - border_px) return forget(map, v, 0, width);
    forget(map, v, 0, border_px);
    forget(map, v, width - border_px, width);
    // An edge is between a pixel and its right or lower neighbour.
    for (int y = std::max(v - reach_px, 0); y <= std::min(v - 1 + reach_px, height - 1); ++y) {
      const std::uint8_t* edge = edges.row(y);
      for (int u = 0; u < width; ++u)
        if (edge[u] != 0) forget(map, v, u + 1 - reach_px, u + 1 + reach_px);
    }
  });
}

}  // namespace softscope
