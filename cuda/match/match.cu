#include <cstring>

#include "cuda/device/device_executor.cuh"
#include "cuda/device/device_stream.h"
#include "cuda/device/event_clock.h"
#include "cuda/match/match.h"
#include "cuda/match/match_passes.h"

namespace softscope::cuda {
namespace {

std::size_t matchBytes(const MatcherOptions& options, int width_px, int height_px) {
  requireMatchLimits(options, width_px, height_px);  // before any allocation
  requireDevice();
  Arena counting;
  MatchLayout(counting, options, width_px, height_px);
  return counting.bytes();
}

}  // namespace

class Matcher::Device {
 public:
  Device(const MatcherOptions& options, int width_px, int height_px)
      : memory_(matchBytes(options, width_px, height_px), "memory for matching"),
        arena_(memory_.data()),
        layout_(arena_, options, width_px, height_px),
        pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
        staging_(kImages * pixels_, "pinned memory for images"),
        inputs_memory_(sizeof(MatchInputs), "pinned memory"),
        list_memory_(sizeof(int) + layout_.slot_count * sizeof(SlotMatch),
                     "pinned memory for matches"),
        executor_(stream_, nullptr),
        passes_(executor_, layout_),
        timed_executor_(stream_, &clock_),
        timed_passes_(timed_executor_, layout_) {}
  ~Device() { cudaStreamSynchronize(stream_); }

  void upload(const MatchPicture& model, const MatchPicture& live) {
    wait();  // the staging memory is free again
    auto* inputs = static_cast<MatchInputs*>(inputs_memory_.data());
    inputs->has_anchor = model.anchor.empty() ? 0 : 1;
    inputs->masked[0] = model.ignore.empty() ? 0 : 1;
    inputs->masked[1] = live.ignore.empty() ? 0 : 1;
    stream_.toDevice(layout_.inputs, inputs, sizeof(MatchInputs));
    const View<std::uint8_t>* gray = layout_.levels.front().gray;
    send(model.gray, 0, gray[0]);
    send(live.gray, 1, gray[1]);
    if (!model.anchor.empty()) send(model.anchor, 2, gray[2]);
    if (!model.ignore.empty()) send(model.ignore, 3, layout_.mask[0]);
    if (!live.ignore.empty()) send(live.ignore, 4, layout_.mask[1]);
  }
  void compute() {
    if (is_timed_) {
      clock_.restart(stream_);
      timed_passes_.match();
      stage_times_ = clock_.laps();
    } else {
      graph_.launch(stream_, [&] { passes_.match(); });
    }
  }
  void wait() { stream_.wait(); }

  std::vector<PixelMatch> download() {
    auto* count = static_cast<int*>(list_memory_.data());
    auto* list = reinterpret_cast<SlotMatch*>(count + 1);
    stream_.fromDevice(count, layout_.match_count, sizeof(int));
    stream_.fromDevice(list, layout_.list, layout_.slot_count * sizeof(SlotMatch));
    wait();
    return pixelMatches(list, *count);
  }

  void timeStages(bool on) { is_timed_ = on; }
  const std::vector<std::pair<std::string, double>>& stageTimes() const { return stage_times_; }
  std::size_t deviceBytes() const { return memory_.bytes(); }

 private:
  static constexpr std::size_t kImages = 5;

  void send(const Raster<std::uint8_t>& image, std::size_t place, const View<std::uint8_t>& to) {
    requireMatchShape(image, to);
    auto* staged = static_cast<std::uint8_t*>(staging_.data()) + place * pixels_;
    std::memcpy(staged, image.values.data(), pixels_);
    stream_.toDevice(to.data, staged, pixels_);
  }

  using Executor = DeviceExecutor<EventClock>;
  DeviceMemory memory_;
  Arena arena_;
  MatchLayout layout_;
  std::size_t pixels_;
  PinnedMemory staging_, inputs_memory_, list_memory_;
  Stream stream_;
  EventClock clock_;
  Executor executor_;
  MatchPasses<Executor> passes_;
  Executor timed_executor_;
  MatchPasses<Executor> timed_passes_;
  Graph graph_;
  bool is_timed_ = false;
  std::vector<std::pair<std::string, double>> stage_times_;
};

Matcher::Matcher(const MatcherOptions& options, int width_px, int height_px)
    : device_(std::make_unique<Device>(options, width_px, height_px)) {}
Matcher::~Matcher() = default;

std::vector<PixelMatch> Matcher::match(const MatchPicture& model, const MatchPicture& live) {
  device_->upload(model, live);
  device_->compute();
  return device_->download();
}
void Matcher::upload(const MatchPicture& model, const MatchPicture& live) {
  device_->upload(model, live);
}
void Matcher::compute() { device_->compute(); }
void Matcher::wait() { device_->wait(); }
std::vector<PixelMatch> Matcher::download() { return device_->download(); }
void Matcher::timeStages(bool on) { device_->timeStages(on); }
const std::vector<std::pair<std::string, double>>& Matcher::stageTimes() const {
  return device_->stageTimes();
}
std::size_t Matcher::deviceBytes() const { return device_->deviceBytes(); }

}  // namespace softscope::cuda
