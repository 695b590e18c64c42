#include "features/gap_filling.h"

#include <cstdint>

#include "core/parallel.h"
#include "features/view_formulas.h"

namespace softscope {
namespace {

/// Row or column of the view: pixel i is at first + i * step.
struct Line {
  ModelView* view;
  std::size_t first, step;
  int count;

  std::size_t at(int i) const { return first + static_cast<std::size_t>(i) * step; }
  float depth(int i) const { return view->depth_mm.values[at(i)]; }
};

/// Fills the pixels between `begin` and `end` with the straight surface between both.
void bridge(const Line& line, int begin, int end) {
  ModelView& view = *line.view;
  const Rgb8 a = view.colour.values[line.at(begin)], b = view.colour.values[line.at(end)];
  const float begin_mm = line.depth(begin), end_mm = line.depth(end);
  for (int i = begin + 1; i < end; ++i) {
    const float share = shareOfGap(begin, i, end);
    const std::size_t at = line.at(i);
    view.depth_mm.values[at] = depthInGap(begin_mm, end_mm, share);
    view.colour.values[at] = {mixBytes(a.red, b.red, share), mixBytes(a.green, b.green, share),
                              mixBytes(a.blue, b.blue, share)};
    view.anchor.values[at] =
        mixBytes(view.anchor.values[line.at(begin)], view.anchor.values[line.at(end)], share);
    view.point_index.values[at] = view.point_index.values[line.at(share < 0.5f ? begin : end)];
  }
}

void fillLine(const Line& line, int gap_px, float step_mm) {
  for (int begin = 0; begin + 2 < line.count; ++begin) {
    const float front = line.depth(begin);
    if (!endsSurface(front, line.depth(begin + 1), step_mm)) continue;
    for (int end = begin + 2; end <= begin + gap_px + 1 && end < line.count; ++end) {
      if (!continuesSurface(front, line.depth(end), step_mm)) continue;
      bridge(line, begin, end);
      begin = end - 1;
      break;
    }
  }
}

}  // namespace

void fillGaps(int gap_px, float step_mm, ModelView* view) {
  if (gap_px < 1) return;
  const int width = view->depth_mm.width_px, height = view->depth_mm.height_px;
  const std::size_t stride = static_cast<std::size_t>(width);
  parallelRows(height, [&](int v) {
    fillLine({view, static_cast<std::size_t>(v) * stride, 1, width}, gap_px, step_mm);
  });
  parallelRanges(width, 64, [&](int begin, int end) {
    for (int u = begin; u < end; ++u)
      fillLine({view, static_cast<std::size_t>(u), stride, height}, gap_px, step_mm);
  });
}

}  // namespace softscope
