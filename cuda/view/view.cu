#include "cuda/device/device_executor.cuh"
#include "cuda/device/device_stream.h"
#include "cuda/device/event_clock.h"
#include "cuda/view/view.h"
#include "cuda/view/view_passes.h"
#include "cuda/view/view_upload.h"

namespace softscope::cuda {
namespace {

std::size_t viewBytes(const PinholeCamera& camera, const ModelViewOptions& options,
                      int point_capacity) {
  requireViewLimits(options);  // before any allocation
  requireDevice();
  Arena counting;
  ViewLayout(counting, camera.width_px, camera.height_px, point_capacity);
  return counting.bytes();
}

/// Data uploaded with each view; pinned.
struct ViewExchange {
  ViewProjector camera;
  int point_count;
};

}  // namespace

class ModelRenderer::Device {
 public:
  Device(const PinholeCamera& camera, const ModelViewOptions& options, int point_capacity)
      : camera_(camera),
        options_(options),
        memory_(viewBytes(camera, options, point_capacity), "memory for the model view"),
        arena_(memory_.data()),
        layout_(arena_, camera.width_px, camera.height_px, point_capacity),
        exchange_memory_(sizeof(ViewExchange), "pinned memory"),
        executor_(stream_, nullptr),
        passes_(executor_, layout_),
        timed_executor_(stream_, &clock_),
        timed_passes_(timed_executor_, layout_) {}
  ~Device() { cudaStreamSynchronize(stream_); }

  void upload(const PointModel& model) { point_count_ = uploadModel(stream_, layout_, model); }
  void draw(const Eigen::Isometry3d& world_from_left) {
    wait();  // the pinned memory is free again
    world_from_left_ = world_from_left;
    auto* exchange = static_cast<ViewExchange*>(exchange_memory_.data());
    *exchange = {viewProjector(camera_, world_from_left, options_), point_count_};
    stream_.toDevice(layout_.camera, &exchange->camera, sizeof(ViewProjector));
    stream_.toDevice(layout_.point_count, &exchange->point_count, sizeof(int));
    if (is_timed_) {
      clock_.restart(stream_);
      timed_passes_.draw(options_);
      stage_times_ = clock_.laps();
    } else {
      graph_.launch(stream_, [&] { passes_.draw(options_); });
    }
  }
  void wait() { stream_.wait(); }

  ModelView download() {
    const int width = camera_.width_px, height = camera_.height_px;
    ModelView view;
    view.camera = camera_;
    view.world_from_left = world_from_left_;
    view.colour = ColourImage(width, height);
    view.anchor = GrayImage(width, height);
    view.depth_mm = Raster<float>(width, height);
    view.point_index = Raster<std::int32_t>(width, height);
    fetch(layout_.images.colour, view.colour);
    fetch(layout_.images.anchor, view.anchor);
    fetch(layout_.images.depth, view.depth_mm);
    fetch(layout_.images.point, view.point_index);
    wait();
    return view;
  }

  void timeStages(bool on) { is_timed_ = on; }
  const std::vector<std::pair<std::string, double>>& stageTimes() const { return stage_times_; }
  std::size_t deviceBytes() const { return memory_.bytes(); }

 private:
  template <class T>
  void fetch(const View<T>& from, Raster<T>& to) {
    stream_.fromDevice(to.values.data(), from.data, to.size() * sizeof(T));
  }

  using Executor = DeviceExecutor<EventClock>;
  PinholeCamera camera_;
  ModelViewOptions options_;
  DeviceMemory memory_;
  Arena arena_;
  ViewLayout layout_;
  PinnedMemory exchange_memory_;
  Stream stream_;
  EventClock clock_;
  Executor executor_;
  ViewPasses<Executor> passes_;
  Executor timed_executor_;
  ViewPasses<Executor> timed_passes_;
  Graph graph_;
  Eigen::Isometry3d world_from_left_ = Eigen::Isometry3d::Identity();
  int point_count_ = 0;
  bool is_timed_ = false;
  std::vector<std::pair<std::string, double>> stage_times_;
};

ModelRenderer::ModelRenderer(const PinholeCamera& camera, const ModelViewOptions& options,
                             int point_capacity)
    : device_(std::make_unique<Device>(camera, options, point_capacity)) {}
ModelRenderer::~ModelRenderer() = default;

void ModelRenderer::upload(const PointModel& model) { device_->upload(model); }
void ModelRenderer::draw(const Eigen::Isometry3d& world_from_left) {
  device_->draw(world_from_left);
}
void ModelRenderer::wait() { device_->wait(); }
ModelView ModelRenderer::download() { return device_->download(); }
void ModelRenderer::timeStages(bool on) { device_->timeStages(on); }
const std::vector<std::pair<std::string, double>>& ModelRenderer::stageTimes() const {
  return device_->stageTimes();
}
std::size_t ModelRenderer::deviceBytes() const { return device_->deviceBytes(); }

}  // namespace softscope::cuda
