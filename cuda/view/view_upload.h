// cuda/view/view_upload.h: the model to the device, for whoever draws it there.
#pragma once

#include <string>

#include "core/error.h"
#include "core/point_model.h"
#include "cuda/device/device_stream.h"
#include "cuda/view/view_layout.h"

namespace softscope::cuda {

/// Throws Error for more points than the capacity.
inline void requireRoom(std::size_t points, const ViewLayout& layout) {
  if (points > static_cast<std::size_t>(layout.capacity))
    throw Error("the model has " + std::to_string(points) +
                " points, but the GPU was prepared for " + std::to_string(layout.capacity));
}

/// Returns the number of points, once all are there. Throws Error for more than the capacity.
inline int uploadModel(const Stream& stream, const ViewLayout& layout, const PointModel& model) {
  static_assert(sizeof(ViewVector) == sizeof(Eigen::Vector3f));
  const std::size_t count = model.size();
  requireRoom(count, layout);
  stream.toDevice(layout.positions_mm, model.positions_mm.data(), count * sizeof(ViewVector));
  stream.toDevice(layout.normals, model.normals.data(), count * sizeof(ViewVector));
  stream.toDevice(layout.colours, model.colours.data(), count * sizeof(Rgb8));
  stream.toDevice(layout.anchors, model.anchors.data(), count);
  stream.wait();  // the model may change
  return static_cast<int>(count);
}

}  // namespace softscope::cuda
