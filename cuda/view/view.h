// cuda/view/view.h: the model view on the GPU.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/camera.h"
#include "core/point_model.h"
#include "features/model_view.h"

namespace softscope::cuda {

/// Renders models of at most `point_capacity` points for one camera; memory is allocated at
/// construction. The same bytes as renderModelView() on the CPU, except the payload of NaN.
class ModelRenderer {
 public:
  /// Throws BackendError without a suitable device, or with too
  /// little memory; OptionError for an option without GPU version.
  ModelRenderer(const PinholeCamera& camera, const ModelViewOptions& options, int point_capacity);
  ~ModelRenderer();
  ModelRenderer(const ModelRenderer&) = delete;
  ModelRenderer& operator=(const ModelRenderer&) = delete;

  /// Throws Error for more points than the capacity.
  void upload(const PointModel& model);
  /// Asynchronous.
  void draw(const Eigen::Isometry3d& world_from_left);
  void wait();
  ModelView download();

  /// With stage times, kernels are launched one by one and draw() waits; otherwise as a graph.
  void timeStages(bool on);
  /// Of the last draw() with stage times: stage, ms.
  const std::vector<std::pair<std::string, double>>& stageTimes() const;

  std::size_t deviceBytes() const;

 private:
  class Device;
  std::unique_ptr<Device> device_;
};

}  // namespace softscope::cuda
