#include "cuda/device/copy_kernel.h"
#include "cuda/device/device_executor.cuh"
#include "cuda/device/device_stream.h"
#include "cuda/device/event_clock.h"
#include "cuda/locate/locate.h"
#include "cuda/locate/locate_passes.h"
#include "cuda/model/shared_model.cuh"
#include "cuda/view/view_upload.h"

namespace softscope::cuda {
namespace {

std::size_t locateBytes(const PinholeCamera& camera, const ModelViewOptions& view,
                        const MatcherOptions& matcher, int point_capacity) {
  requireViewLimits(view);  // before any memory is taken
  requireMatchLimits(matcher, camera.width_px, camera.height_px);
  requireDevice();
  Arena counting;
  LocateLayout(counting, matcher, camera.width_px, camera.height_px, point_capacity);
  return counting.bytes();
}

/// What crosses to the device with each call; pinned.
struct LocateExchange {
  ViewProjector camera;
  LiftInputs lift;
  MatchInputs match;
  int point_count, match_count, lifted_count;
};

}  // namespace

class Locator::Device {
 public:
  Device(const PinholeCamera& camera, const ModelViewOptions& view, const MatcherOptions& matcher,
         int point_capacity)
      : camera_(camera),
        view_options_(view),
        memory_(locateBytes(camera, view, matcher, point_capacity), "memory for locating"),
        arena_(memory_.data()),
        layout_(arena_, matcher, camera.width_px, camera.height_px, point_capacity),
        exchange_memory_(sizeof(LocateExchange), "pinned memory"),
        matches_memory_(layout_.match.slot_count * (sizeof(SlotMatch) + sizeof(LiftSlot)),
                        "pinned memory for matches"),
        executor_(stream_, nullptr),
        passes_(executor_, layout_),
        timed_executor_(stream_, &clock_),
        timed_passes_(timed_executor_, layout_) {}
  ~Device() { cudaStreamSynchronize(stream_); }

  void setModel(const PointModel& model) {
    point_count_ = uploadModel(stream_, layout_.view, model);
  }
  void setModel(const PointModel& model, SharedModel& on_device) {
    requireRoom(model.size(), layout_.view);
    point_count_ = static_cast<int>(model.size());
    Link link{stream_, executor_};
    const ModelArrays& from = on_device.bring(model, kModelShape | kModelLooks, 0, link);
    CopyKernel copy;  // the graphs read from one place
    copy.add(reinterpret_cast<const ViewVector*>(from.positions_mm), layout_.view.positions_mm,
             model.size());
    copy.add(reinterpret_cast<const ViewVector*>(from.normals), layout_.view.normals, model.size());
    copy.add(from.colours, layout_.view.colours, model.size());
    copy.add(from.anchors, layout_.view.anchors, model.size());
    executor_.launch("copy", copy, copy.blocks());
  }
  void setLive(const MatchPicture& live, const DepthMap& depth) {
    send(live.gray, layout_.match.levels.front().gray[1]);
    is_live_masked_ = !live.ignore.empty();
    if (is_live_masked_) send(live.ignore, layout_.match.mask[1]);
    send(depth.depth_mm, layout_.live_depth);
    if (!depth.sigma_mm.empty())
      send(depth.sigma_mm, layout_.live_sigma);
    else
      forgetSigma(depth.depth_mm.size());
    wait();
  }
  void setLive(const SharedRasters& from) {
    is_live_masked_ = from.ignore != nullptr;
    const std::size_t pixels =
        static_cast<std::size_t>(camera_.width_px) * static_cast<std::size_t>(camera_.height_px);
    CopyKernel copy;
    copy.add(from.match_gray, layout_.match.levels.front().gray[1].data, pixels);
    if (is_live_masked_) copy.add(from.ignore, layout_.match.mask[1].data, pixels);
    copy.add(from.depth_mm, layout_.live_depth.data, pixels);
    if (from.sigma_mm != nullptr)
      copy.add(from.sigma_mm, layout_.live_sigma.data, pixels);
    else
      forgetSigma(pixels);
    executor_.launch("copy", copy, copy.blocks());
  }
  void setSeenGray(const GrayImage& gray) {
    has_seen_gray_ = !gray.empty();
    if (!has_seen_gray_) return;
    send(gray, layout_.match.levels.front().gray[0]);
    wait();
  }

  void locate(const Eigen::Isometry3d& world_from_left) {
    wait();  // the pinned memory is free again
    exchange().camera = viewProjector(camera_, world_from_left, view_options_);
    exchange().lift = {camera_, rigidRows(world_from_left)};
    exchange().match = {has_seen_gray_ ? 0 : 1, {1, is_live_masked_ ? 1 : 0}};
    exchange().point_count = point_count_;
    stream_.toDevice(layout_.view.point_count, &exchange().point_count, sizeof(int));
    stream_.toDevice(layout_.view.camera, &exchange().camera, sizeof(ViewProjector));
    stream_.toDevice(layout_.inputs, &exchange().lift, sizeof(LiftInputs));
    stream_.toDevice(layout_.match.inputs, &exchange().match, sizeof(MatchInputs));
    if (is_timed_) {
      clock_.restart(stream_);
      timed_passes_.locate(view_options_, has_seen_gray_);
      stage_times_ = clock_.laps();
    } else {
      graphs_[has_seen_gray_ ? 1 : 0].launch(
          stream_, [&] { passes_.locate(view_options_, has_seen_gray_); });
    }
  }
  void wait() { stream_.wait(); }

  LocatedMatches download() {
    const std::size_t slots = layout_.match.slot_count;
    auto* pixels = static_cast<SlotMatch*>(matches_memory_.data());
    auto* lifted = reinterpret_cast<LiftSlot*>(pixels + slots);
    stream_.fromDevice(&exchange().match_count, layout_.match.match_count, sizeof(int));
    stream_.fromDevice(&exchange().lifted_count, layout_.lifted_count, sizeof(int));
    wait();
    const auto bytes = [](int count, std::size_t each) {
      return static_cast<std::size_t>(count) * each;
    };
    stream_.fromDevice(pixels, layout_.match.list,
                       bytes(exchange().match_count, sizeof(SlotMatch)));
    stream_.fromDevice(lifted, layout_.list, bytes(exchange().lifted_count, sizeof(LiftSlot)));
    wait();
    return {pixelMatches(pixels, exchange().match_count),
            liftedMatches(lifted, exchange().lifted_count)};
  }

  void timeStages(bool on) { is_timed_ = on; }
  const std::vector<std::pair<std::string, double>>& stageTimes() const { return stage_times_; }
  std::size_t deviceBytes() const { return memory_.bytes(); }

 private:
  /// NaN.
  void forgetSigma(std::size_t pixels) {
    check(cudaMemsetAsync(layout_.live_sigma.data, 0xFF, pixels * sizeof(float), stream_),
          "setting memory");
  }
  LocateExchange& exchange() { return *static_cast<LocateExchange*>(exchange_memory_.data()); }
  template <class T>
  void send(const Raster<T>& image, const View<T>& to) {
    requireMatchShape(image, to);
    stream_.toDevice(to.data, image.values.data(), image.size() * sizeof(T));
  }

  using Executor = DeviceExecutor<EventClock>;
  /// For ModelHome::bring().
  struct Link {
    Stream& stream;
    Executor& work;
    Executor& executor() { return work; }
    void toDevice(void* to, const void* from, std::size_t bytes) const {
      stream.toDevice(to, from, bytes);
    }
    void wait() const { stream.wait(); }
  };

  PinholeCamera camera_;
  ModelViewOptions view_options_;
  DeviceMemory memory_;
  Arena arena_;
  LocateLayout layout_;
  PinnedMemory exchange_memory_, matches_memory_;
  Stream stream_;
  EventClock clock_;
  Executor executor_;
  LocatePasses<Executor> passes_;
  Executor timed_executor_;
  LocatePasses<Executor> timed_passes_;
  Graph graphs_[2];
  int point_count_ = 0;
  bool is_live_masked_ = false, has_seen_gray_ = false, is_timed_ = false;
  std::vector<std::pair<std::string, double>> stage_times_;
};

Locator::Locator(const PinholeCamera& camera, const ModelViewOptions& view,
                 const MatcherOptions& matcher, int point_capacity)
    : device_(std::make_unique<Device>(camera, view, matcher, point_capacity)) {}
Locator::~Locator() = default;

void Locator::setModel(const PointModel& model) { device_->setModel(model); }
void Locator::setModel(const PointModel& model, SharedModel& on_device) {
  device_->setModel(model, on_device);
}
void Locator::setLive(const MatchPicture& live, const DepthMap& depth) {
  device_->setLive(live, depth);
}
void Locator::setLive(const SharedRasters& from) { device_->setLive(from); }
void Locator::setSeenGray(const GrayImage& gray) { device_->setSeenGray(gray); }
void Locator::locate(const Eigen::Isometry3d& world_from_left) { device_->locate(world_from_left); }
void Locator::wait() { device_->wait(); }
LocatedMatches Locator::download() { return device_->download(); }
void Locator::timeStages(bool on) { device_->timeStages(on); }
const std::vector<std::pair<std::string, double>>& Locator::stageTimes() const {
  return device_->stageTimes();
}
std::size_t Locator::deviceBytes() const { return device_->deviceBytes(); }

}  // namespace softscope::cuda
