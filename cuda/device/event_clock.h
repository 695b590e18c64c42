// cuda/device/event_clock.h: time of each stage on the device.
#pragma once

#include <cuda_runtime_api.h>

#include <string>
#include <utility>
#include <vector>

#include "cuda/device/device_memory.h"

namespace softscope::cuda {

/// Events between stages of one stream.
class EventClock {
 public:
  EventClock() = default;
  EventClock(const EventClock&) = delete;
  EventClock& operator=(const EventClock&) = delete;
  ~EventClock() {
    for (const cudaEvent_t event : events_) cudaEventDestroy(event);
  }

  void restart(cudaStream_t stream) {
    stages_.clear();
    note(0, stream);
  }
  void mark(const char* stage, cudaStream_t stream) {
    stages_.emplace_back(stage);
    note(stages_.size(), stream);
  }
  /// Waits for the last stage. Repeated stages are summed.
  std::vector<std::pair<std::string, double>> laps() {
    std::vector<std::pair<std::string, double>> laps;
    if (stages_.empty()) return laps;
    check(cudaEventSynchronize(events_[stages_.size()]), "waiting for the last stage");
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      float elapsed_ms = 0;
      check(cudaEventElapsedTime(&elapsed_ms, events_[i], events_[i + 1]),
            "reading a stage's time");
      add(stages_[i], elapsed_ms, laps);
    }
    return laps;
  }

 private:
  void note(std::size_t index, cudaStream_t stream) {
    while (events_.size() <= index) {
      cudaEvent_t event = nullptr;
      check(cudaEventCreate(&event), "creating an event");
      events_.push_back(event);
    }
    check(cudaEventRecord(events_[index], stream), "recording an event");
  }
  static void add(const std::string& stage, double elapsed_ms,
                  std::vector<std::pair<std::string, double>>& laps) {
    for (auto& [name, sum_ms] : laps)
      if (name == stage) {
        sum_ms += elapsed_ms;
        return;
      }
    laps.emplace_back(stage, elapsed_ms);
  }

  std::vector<cudaEvent_t> events_;
  std::vector<std::string> stages_;
};

}  // namespace softscope::cuda
