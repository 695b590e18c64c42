// cuda/device/device_stream.h: the device in use, an owned stream, and a sequence of launches as a
// graph.
#pragma once

#include <cuda_runtime_api.h>

#include <cstddef>

#include "core/error.h"
#include "cuda/device/device_info.h"
#include "cuda/device/device_memory.h"

namespace softscope::cuda {

/// Throws if no kernel of this build can run.
inline void requireDevice() {
  const DeviceInfo info = queryDevices();
  if (info.devices.empty()) throw BackendError("CUDA: " + info.why_none);
  if (!info.devices.front().problem.empty())
    throw BackendError("CUDA: " + info.devices.front().name + ": " + info.devices.front().problem +
                       ". This build has machine code for compute capability 7.5 and newer");
  check(cudaSetDevice(0), "choosing the first device");
}

class Stream {
 public:
  Stream() { check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "a stream"); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { cudaStreamDestroy(stream_); }
  operator cudaStream_t() const { return stream_; }

  // Asynchronous: the memory of the host must be unchanged until wait() returns.
  void toDevice(void* to, const void* from, std::size_t bytes) const {
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream_),
          "copying to the device");
  }
  void fromDevice(void* to, const void* from, std::size_t bytes) const {
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream_),
          "copying from the device");
  }
  void wait() const { check(cudaStreamSynchronize(stream_), "waiting for the device"); }

 private:
  cudaStream_t stream_ = nullptr;
};

/// Sequence of launches started by one call.
class Graph {
 public:
  Graph() = default;
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;
  ~Graph() {
    if (graph_ != nullptr) cudaGraphExecDestroy(graph_);
  }
  /// Captures the work of `enqueue()` on the stream on first use, and launches it.
  template <class Enqueue>
  void launch(cudaStream_t stream, const Enqueue& enqueue) {
    if (graph_ == nullptr) capture(stream, enqueue);
    check(cudaGraphLaunch(graph_, stream), "starting a graph");
  }

 private:
  template <class Enqueue>
  void capture(cudaStream_t stream, const Enqueue& enqueue) {
    check(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal), "capturing a graph");
    cudaGraph_t captured = nullptr;
    try {
      enqueue();
    } catch (...) {
      cudaStreamEndCapture(stream, &captured);
      if (captured != nullptr) cudaGraphDestroy(captured);
      throw;
    }
    check(cudaStreamEndCapture(stream, &captured), "capturing a graph");
    const cudaError_t status = cudaGraphInstantiate(&graph_, captured, 0);
    cudaGraphDestroy(captured);
    check(status, "building a graph");
  }
  cudaGraphExec_t graph_ = nullptr;
};

}  // namespace softscope::cuda
