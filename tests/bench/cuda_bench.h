// tests/bench/cuda_bench.h: what the benchmarks of the GPU share: images, stages, exit codes.
#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "core/rectified_rig.h"
#include "cuda/device/device_info.h"
#include "tests/bench/bench_times.h"

namespace softscope::bench {

inline GrayImage readPgm(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, most = 0;
  file >> magic >> width >> height >> most;
  file.get();
  if (!file || magic != "P5" || most != 255)
    throw InputError(path + ": not a binary 8-bit PGM without comments");
  GrayImage image(width, height);
  file.read(reinterpret_cast<char*>(image.values.data()),
            static_cast<std::streamsize>(image.size()));
  if (!file) throw InputError(path + ": too short");
  return image;
}

/// Of a scope that took this image.
inline RectifiedRig rigOf(const GrayImage& image) {
  RectifiedRig rig;
  rig.left = {image.width_px,
              image.height_px,
              600,
              600,
              image.width_px / 2.0 + 0.3,
              image.height_px / 2.0 - 0.2};
  rig.baseline_mm = 5;
  return rig;
}

/// `work()` enqueues the stage and waits.
template <class Stage, class Work>
void printStages(Stage& stage, const Work& work) {
  stage.timeStages(true);
  std::map<std::string, std::vector<double>> laps;
  std::vector<std::string> order;
  for (int i = 0; i < 60; ++i) {
    work();
    for (const auto& [name, elapsed_ms] : stage.stageTimes()) {
      if (laps.find(name) == laps.end()) order.push_back(name);
      laps[name].push_back(elapsed_ms);
    }
  }
  stage.timeStages(false);
  std::printf("  stages launched one by one, p50 in us:");
  for (const std::string& name : order)
    std::printf(" %s %.1f;", name.c_str(), 1000 * atShare(laps[name], 0.5));
  std::printf("\n");
}

/// Names the GPU and runs `work()`, which returns the exit code; that of an error otherwise.
template <class Work>
int onDevice(const Work& work) {
  return orErrorCode([&] {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (!info.devices.empty())
      std::printf("%s, driver CUDA %s, runtime %s\n", info.devices.front().name.c_str(),
                  info.driver_version.c_str(), info.runtime_version.c_str());
    return work();
  });
}

}  // namespace softscope::bench
