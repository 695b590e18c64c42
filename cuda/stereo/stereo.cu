#include <algorithm>
#include <array>
#include <cstring>
#include <future>
#include <limits>

#include "cuda/device/device_executor.cuh"
#include "cuda/device/device_stream.h"
#include "cuda/device/event_clock.h"
#include "cuda/stereo/coarser_levels.h"
#include "cuda/stereo/stereo.h"
#include "cuda/stereo/stereo_passes.h"

namespace softscope::cuda {
namespace {

std::size_t bytesFor(const StereoOptions& options, int width_px, int height_px) {
  Arena counting;
  StereoLayout(counting, options, width_px, height_px);
  return counting.bytes();
}

/// Data exchanged between host and device; pinned.
struct Exchange {
  FrameInputs inputs;
  OpenShare shares[16];
};

}  // namespace

class Stereo::Device {
 public:
  Device(const StereoOptions& options, const RectifiedRig& rig, int width_px, int height_px)
      : memory_((check(options, width_px), bytesFor(options, width_px, height_px)),
                "memory for stereo"),
        arena_(memory_.data()),
        layout_(arena_, options, width_px, height_px),
        rig_(rig),
        pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
        staging_(4 * pixels_, "pinned memory for images"),
        exchange_memory_(sizeof(Exchange), "pinned memory"),
        results_memory_(pixels_ * (kRasters * sizeof(float) + sizeof(NormalPixel)),
                        "pinned memory for depth"),
        executor_(stream_, nullptr),
        passes_(executor_, layout_),
        side_executor_(side_stream_, nullptr),
        side_passes_(side_executor_, layout_),
        timed_executor_(stream_, &clock_),
        timed_passes_(timed_executor_, layout_),
        levels_(layout_.levels.size()),
        shares_(layout_.levels.size()),
        ascents_(layout_.levels.size()) {
    std::memset(exchange_memory_.data(), 0, sizeof(Exchange));
    passes_.initialise();
    for (cudaEvent_t* event : {&share_read_, &level_done_, &normals_arrived_})
      cuda::check(cudaEventCreateWithFlags(event, cudaEventDisableTiming), "an event");
    wait();
  }
  ~Device() {
    waitForNormals();
    cudaStreamSynchronize(side_stream_);
    cudaStreamSynchronize(stream_);
    cudaEventDestroy(share_read_);
    cudaEventDestroy(level_done_);
    cudaEventDestroy(normals_arrived_);
  }

  void upload(const MatchableViews& views) {
    requireShape(views.left);
    requireShape(views.right);
    auto* staged = static_cast<std::uint8_t*>(stage());
    const GrayImage* images[] = {&views.left, &views.right};
    for (int view = 0; view < 2; ++view) {
      std::memcpy(staged + view * pixels_, images[view]->values.data(), pixels_);
      stream_.toDevice(full().gray[view].data, staged + view * pixels_, pixels_);
    }
    const bool ignores = !views.ignored.left.empty() || !views.ignored.right.empty();
    if (ignores || has_ignored_) uploadIgnored(views.ignored, staged + 2 * pixels_);
    has_ignored_ = ignores;
  }
  void setMask(const Mask& mask) {
    wait();
    if (!mask.empty()) requireShape(mask);
    exchange().inputs.masked = mask.empty() ? 0 : 1;
    if (mask.empty()) return;
    stream_.toDevice(layout_.mask.data, mask.values.data(), pixels_);
    wait();
  }

  void compute(double roll_rad) {
    if (is_enqueued_) wait();  // the exchange is in use
    exchange().inputs.roll_rad = roll_rad;
    is_enqueued_ = true;
    if (is_timed_) {
      clock_.restart(stream_);
      run(timed_passes_, [](Graph&, cudaStream_t, const auto& enqueue) { enqueue(); });
      stage_times_ = clock_.laps();
    } else {
      run(passes_, [](Graph& graph, cudaStream_t stream, const auto& enqueue) {
        graph.launch(stream, enqueue);
      });
    }
  }
  void wait() {
    stream_.wait();
    is_enqueued_ = false;
  }

  StereoDepth download() {
    StereoDepth found;
    found.depth = downloadDepth();
    found.disparity = downloadDisparity();
    found.normals = downloadNormals().get();
    found.levels = levels_run_;
    return found;
  }
  DisparityMap downloadDisparity() {
    wait();
    DisparityMap found;
    Copies copies =
        copyTo({{{layout_.disparity, &found.disparity_px}, {layout_.sigma, &found.sigma_px}}});
    finish(&copies);
    return found;
  }
  DepthMap downloadDepth() {
    wait();
    DepthMap found;
    Copies copies =
        copyTo({{{layout_.depth, &found.depth_mm}, {layout_.depth_sigma, &found.sigma_mm}}});
    finish(&copies);
    return found;
  }
  /// What is enqueued later comes after the copy on the device's side.
  std::future<NormalMap> downloadNormals() {
    waitForNormals();
    auto* arrived = reinterpret_cast<NormalPixel*>(static_cast<float*>(results_memory_.data()) +
                                                   kRasters * pixels_);
    fetch(layout_.normals, arrived);
    cuda::check(cudaEventRecord(normals_arrived_, stream_), "recording an event");
    std::promise<void> copied;
    normals_copied_ = copied.get_future();
    return std::async(std::launch::async, [this, arrived, copied = std::move(copied)]() mutable {
      const std::promise<void> ends = std::move(copied);  // is told when it goes, whatever happens
      cuda::check(cudaEventSynchronize(normals_arrived_), "waiting for normals");
      static_assert(sizeof(NormalPixel) == sizeof(Eigen::Vector3f));
      const auto* from = reinterpret_cast<const Eigen::Vector3f*>(arrived);
      NormalMap normals;
      normals.width_px = full().width;
      normals.height_px = full().height;
      copyInParts(from, &normals.values);
      return normals;
    });
  }
  void drop(const Mask& mask) {
    requireShape(mask);
    stream_.toDevice(layout_.dropped.data, mask.values.data(), pixels_);
    passes_.drop();
    wait();
  }
  SharedRasters rasters() const {
    SharedRasters measured;
    measured.depth_mm = layout_.depth.data;
    measured.sigma_mm = layout_.depth_sigma.data;
    measured.normals = reinterpret_cast<const Eigen::Vector3f*>(layout_.normals.data);
    return measured;
  }

  void timeStages(bool on) { is_timed_ = on; }
  const std::vector<std::pair<std::string, double>>& stageTimes() const { return stage_times_; }
  std::size_t deviceBytes() const { return memory_.bytes(); }

 private:
  static constexpr int kRasters = 2;  // of floats, that are copied at a time, beside the normals
  struct RasterCopy {
    View<float> from;
    Raster<float>* to;
  };
  using Copies = std::array<std::future<void>, kRasters>;

  /// Checks before any allocation.
  static void check(const StereoOptions& options, int width_px) {
    requireDeviceLimits(options, width_px);
    requireDevice();
  }
  const StereoLevel& full() const { return layout_.levels.front(); }
  const StereoLevel& level(int k) const { return layout_.levels[static_cast<std::size_t>(k)]; }
  Exchange& exchange() { return *static_cast<Exchange*>(exchange_memory_.data()); }

  template <class Image>
  void requireShape(const Image& image) const {
    if (image.width_px == full().width && image.height_px == full().height) return;
    throw InputError("the image has " + std::to_string(image.width_px) + " x " +
                     std::to_string(image.height_px) + " pixels, but the GPU was prepared for " +
                     std::to_string(full().width) + " x " + std::to_string(full().height));
  }
  void uploadIgnored(const ViewMasks& ignored, std::uint8_t* staged) {
    const Mask* masks[] = {&ignored.left, &ignored.right};
    for (int view = 0; view < 2; ++view) {
      const Mask& mask = *masks[view];
      std::uint8_t* to = staged + static_cast<std::size_t>(view) * pixels_;
      if (mask.empty()) {
        std::fill_n(to, pixels_, std::uint8_t{0});
      } else {
        requireShape(mask);
        std::transform(mask.values.begin(), mask.values.end(), to, ignoredBits);
      }
      stream_.toDevice(full().ignored[view].data, to, pixels_);
    }
  }
  /// Staging memory, after its last use.
  void* stage() {
    wait();
    return staging_.data();
  }
  template <class T>
  void fetch(const View<T>& from, T* to) {
    stream_.fromDevice(to, from.data, pixels_ * sizeof(T));
  }

  /// Begins copies by a thread each, through pinned memory.
  Copies copyTo(const std::array<RasterCopy, kRasters>& rasters) {
    auto* arrived = static_cast<float*>(results_memory_.data());
    for (int i = 0; i < kRasters; ++i) fetch(rasters[i].from, arrived + i * pixels_);
    wait();
    Copies copies;
    for (int i = 0; i < kRasters; ++i)
      copies[i] = std::async(std::launch::async, [=, to = rasters[i].to] {
        constexpr float kNan =
            std::numeric_limits<float>::quiet_NaN();  // one of many, as on the CPU
        *to = Raster<float>(full().width, full().height);
        std::transform(arrived + i * pixels_, arrived + (i + 1) * pixels_, to->values.data(),
                       [](float value) { return value == value ? value : kNan; });
      });
    return copies;
  }
  static void finish(Copies* copies) {
    for (std::future<void>& copy : *copies) copy.get();
  }

  /// Each part by a thread: what limits it are the pages of new memory.
  void copyInParts(const Eigen::Vector3f* from, std::vector<Eigen::Vector3f>* to) const {
    constexpr std::size_t kParts = 4;
    to->resize(pixels_);  // vectors without a value are not set to zero
    std::future<void> parts[kParts];
    for (std::size_t part = 0; part < kParts; ++part)
      parts[part] = std::async(std::launch::async, [=] {
        const std::size_t begin = part * pixels_ / kParts, end = (part + 1) * pixels_ / kParts;
        std::copy(from + begin, from + end, to->data() + begin);
      });
    for (std::future<void>& part : parts) part.get();
  }
  /// Whatever became of them.
  void waitForNormals() {
    if (normals_copied_.valid()) normals_copied_.wait();
  }

  /// In parallel to the main stream, whose next kernels do not change the measured data.
  template <class Launch>
  void measureShare(int k, const Launch& launch) {
    if (layout_.levels.size() == 1) return;
    cuda::check(cudaEventRecord(level_done_, stream_), "recording an event");
    cuda::check(cudaStreamWaitEvent(side_stream_, level_done_, 0), "waiting for a level");
    launch(shares_[static_cast<std::size_t>(k)], side_stream_, [this, k] {
      side_passes_.measureShare(level(k));
      side_stream_.fromDevice(&exchange().shares[k], &level(k).counters->share, sizeof(OpenShare));
    });
    cuda::check(cudaEventRecord(share_read_, side_stream_), "recording an event");
  }

  /// `launch(graph, stream, enqueue)`: enqueues, or launches the graph of it.
  template <class Passes, class Launch>
  void run(Passes& passes, const Launch& launch) {
    const auto finish = [&] { launch(finish_, stream_, [&] { passes.finish(rig_); }); };
    const auto matchLevel = [&](int k, const auto& begin) {
      launch(levels_[static_cast<std::size_t>(k)], stream_, [&] {
        begin();
        passes.matchLevel(level(k));
      });
    };
    matchLevel(0,
               [&] { stream_.toDevice(layout_.inputs, &exchange().inputs, sizeof(FrameInputs)); });
    // In most frames the full size is enough: the rest follows while the host looks.
    measureShare(0, launch);
    finish();
    levels_run_ = runCoarserLevels(
        layout_,
        [&](int k) {
          cuda::check(cudaEventSynchronize(share_read_), "waiting for a level");
          return exchange().shares[k];
        },
        [&](int k) {
          matchLevel(k, [&] { passes.halve(level(k - 1), level(k)); });
          measureShare(k, launch);
        },
        [&](int k) {
          launch(ascents_[static_cast<std::size_t>(k)], stream_,
                 [&] { passes.fillFromHalf(level(k + 1), level(k)); });
        });
    if (levels_run_ > 1) finish();
  }

  using Executor = DeviceExecutor<EventClock>;
  DeviceMemory memory_;
  Arena arena_;
  StereoLayout layout_;
  RectifiedRig rig_;
  std::size_t pixels_;
  PinnedMemory staging_, exchange_memory_, results_memory_;
  Stream stream_, side_stream_;
  EventClock clock_;
  Executor executor_;
  StereoPasses<Executor> passes_;
  Executor side_executor_;
  StereoPasses<Executor> side_passes_;
  Executor timed_executor_;
  StereoPasses<Executor> timed_passes_;
  std::vector<Graph> levels_, shares_, ascents_;
  Graph finish_;
  cudaEvent_t share_read_ = nullptr, level_done_ = nullptr, normals_arrived_ = nullptr;
  std::future<void> normals_copied_;
  bool is_enqueued_ = false, is_timed_ = false, has_ignored_ = false;
  int levels_run_ = 0;
  std::vector<std::pair<std::string, double>> stage_times_;
};

Stereo::Stereo(const StereoOptions& options, const RectifiedRig& rig, int width_px, int height_px)
    : device_(std::make_unique<Device>(options, rig, width_px, height_px)) {}
Stereo::~Stereo() = default;

void Stereo::upload(const MatchableViews& views) { device_->upload(views); }
void Stereo::setMask(const Mask& mask) { device_->setMask(mask); }
void Stereo::compute(double roll_rad) { device_->compute(roll_rad); }
void Stereo::wait() { device_->wait(); }
StereoDepth Stereo::download() { return device_->download(); }
DepthMap Stereo::downloadDepth() { return device_->downloadDepth(); }
DisparityMap Stereo::downloadDisparity() { return device_->downloadDisparity(); }
std::future<NormalMap> Stereo::downloadNormals() { return device_->downloadNormals(); }
void Stereo::drop(const Mask& mask) { device_->drop(mask); }
SharedRasters Stereo::rasters() const { return device_->rasters(); }
void Stereo::timeStages(bool on) { device_->timeStages(on); }
const std::vector<std::pair<std::string, double>>& Stereo::stageTimes() const {
  return device_->stageTimes();
}
std::size_t Stereo::deviceBytes() const { return device_->deviceBytes(); }

}  // namespace softscope::cuda
