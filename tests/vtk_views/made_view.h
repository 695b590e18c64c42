// tests/vtk_views/made_view.h: a red patch that moves to the right, seen by a scope.
#pragma once

#include "vtk_views/viewer/view_source.h"

namespace softscope::test {

/// A patch of 40 x 40 mm, 50 mm before the scope, 10 mm farther to the right every moment; weights
/// 0 to 10 from left to right; errors at even frames, 0.1 mm everywhere; one node at its centre.
class MadeSource : public ViewSource {
 public:
  explicit MadeSource(int count) : count_(count) {
    world_.left = {640, 480, 560, 560, 319.5, 239.5};
    world_.has_errors = world_.has_weights = world_.has_nodes = true;
    world_.errors.limit_mm = 0.2;
  }

  const ViewWorld& world() const override { return world_; }
  int count() const override { return count_; }
  int frameOf(int index) const override { return 10 * index; }
  double secondsOf(int index) const override { return 0.4 * index; }
  bool live() const override { return live_; }
  bool stopped() const override { return stopped_; }
  void look() override { count_ = grown_; }
  std::shared_ptr<const ViewMoment> moment(int index, bool with_errors) override {
    ++read;
    auto moment = std::make_shared<ViewMoment>();
    moment->frame = frameOf(index);
    moment->time_s = secondsOf(index);
    moment->world_from_left = Eigen::Isometry3d::Identity();
    for (int y = -50; y <= 50; ++y)
      for (int x = -50; x <= 50; ++x) {
        moment->model.vertices_mm.emplace_back(0.4f * float(x) + 10.f * float(index),
                                               0.4f * float(y), 50.f);
        moment->model.colours.push_back({200, 60, 60});
        moment->weights.push_back(0.1f * float(x + 50));
      }
    moment->nodes_mm = {{10.f * float(index), 0, 50}};
    if (with_errors && index % 2 == 0) {
      moment->judged.vertices_mm = moment->model.vertices_mm;
      moment->errors_mm.assign(moment->model.vertices_mm.size(), 0.1);
    }
    return moment;
  }

  /// A run in progress, with `grown` frames at the next poll.
  void goOn(int grown) {
    live_ = true;
    grown_ = grown;
  }

  /// Its writer is gone.
  void stop() { stopped_ = live_ = true; }

  int read = 0;  // how many moments were asked for

 private:
  int count_, grown_ = 0;
  bool live_ = false, stopped_ = false;
  ViewWorld world_;
};

/// Pixels near `colour`, by at most `by` in each channel.
inline int countNear(const ColourImage& picture, Rgb8 colour, int by) {
  int count = 0;
  for (const Rgb8 c : picture.values)
    count += std::abs(c.red - colour.red) <= by && std::abs(c.green - colour.green) <= by &&
             std::abs(c.blue - colour.blue) <= by;
  return count;
}

/// Mean column of the pixels near a colour.
inline double meanColumn(const ColourImage& picture, Rgb8 colour, int by) {
  double sum = 0;
  int count = 0;
  for (int v = 0; v < picture.height_px; ++v)
    for (int u = 0; u < picture.width_px; ++u) {
      const Rgb8 c = picture.at(u, v);
      if (std::abs(c.red - colour.red) > by || std::abs(c.green - colour.green) > by ||
          std::abs(c.blue - colour.blue) > by)
        continue;
      sum += u;
      ++count;
    }
  return sum / std::max(count, 1);
}

inline constexpr Rgb8 kPatchRed{200, 60, 60};

}  // namespace softscope::test
