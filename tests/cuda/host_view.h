// tests/cuda/host_view.h: the kernels of the model view, run by the host executor.
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "core/point_model.h"
#include "cuda/device/host_executor.h"
#include "cuda/view/view_passes.h"
#include "host_memory.h"

namespace softscope::test {

class HostView {
 public:
  HostView(const PinholeCamera& camera, int point_capacity, unsigned seed)
      : camera_(camera),
        executor_(seed),
        memory_(bytesFor(camera, point_capacity)),
        arena_(memory_.data()),
        layout_(arena_, camera.width_px, camera.height_px, point_capacity),
        passes_(executor_, layout_) {}

  ModelView draw(const PointModel& model, const Eigen::Isometry3d& world_from_left,
                 const ModelViewOptions& options) {
    const std::size_t count = model.size();
    copy(layout_.positions_mm, model.positions_mm.data(), count * sizeof(ViewVector));
    copy(layout_.normals, model.normals.data(), count * sizeof(ViewVector));
    copy(layout_.colours, model.colours.data(), count * sizeof(Rgb8));
    copy(layout_.anchors, model.anchors.data(), count);
    *layout_.camera = viewProjector(camera_, world_from_left, options);
    *layout_.point_count = static_cast<int>(count);
    passes_.draw(options);
    ModelView view;
    view.colour = rasterOf<Rgb8>(layout_.images.colour);
    view.anchor = rasterOf<std::uint8_t>(layout_.images.anchor);
    view.depth_mm = rasterOf<float>(layout_.images.depth);
    view.point_index = rasterOf<std::int32_t>(layout_.images.point);
    return view;
  }

 private:
  static void copy(void* to, const void* from, std::size_t bytes) {
    if (bytes > 0) std::memcpy(to, from, bytes);
  }
  template <class T>
  static Raster<T> rasterOf(const cuda::View<T>& view) {
    Raster<T> raster(view.width, view.height);
    std::copy_n(view.data, raster.size(), raster.values.data());
    return raster;
  }
  static std::size_t bytesFor(const PinholeCamera& camera, int point_capacity) {
    cuda::Arena counting;
    cuda::ViewLayout(counting, camera.width_px, camera.height_px, point_capacity);
    return counting.bytes();
  }

  PinholeCamera camera_;
  cuda::HostExecutor executor_;
  HostMemory memory_;
  cuda::Arena arena_;
  cuda::ViewLayout layout_;
  cuda::ViewPasses<cuda::HostExecutor> passes_;
};

}  // namespace softscope::test
