// tests/fusion/memory_test.cpp: a long run of the same view costs no more than a short one.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "fusion/made_shots.h"

namespace {

std::atomic<long> allocated_bytes{0},
    peak_bytes{0};  // of everything that this program allocates with new

void* counted(std::size_t size) {
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  const long bytes = allocated_bytes += static_cast<long>(malloc_usable_size(memory));
  long peak = peak_bytes;
  while (bytes > peak && !peak_bytes.compare_exchange_weak(peak, bytes))
    ;
  return memory;
}

void uncounted(void* memory) {
  if (memory != nullptr) allocated_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { uncounted(memory); }
void operator delete[](void* memory) noexcept { uncounted(memory); }
void operator delete(void* memory, std::size_t) noexcept { uncounted(memory); }
void operator delete[](void* memory, std::size_t) noexcept { uncounted(memory); }

namespace softscope::test {
namespace {

// The peak holds rasters too: 640 x 480 pixels, counted apart by an update of the empty model.
TEST(Memory, StaysBelow200BytesAPoint) {
  Shot nothing = takeShot(plane(55), smallCamera(640, 480));
  Shot shot = nothing;
  std::fill(nothing.depth.depth_mm.values.begin(), nothing.depth.depth_mm.values.end(), kNoDepth);
  PointModel model;
  InsertionMemory memory;
  const auto peakOf = [&](const Shot& seen) {
    peak_bytes = allocated_bytes.load();
    update(seen, {}, &memory, &model);
    return peak_bytes.load();
  };
  peakOf(nothing);
  const long rasters = peakOf(nothing);
  update(shot, {}, &memory, &model);
  const long all = peakOf(shot);
  ASSERT_GT(model.size(), 60000u);
  EXPECT_LT(static_cast<double>(all - rasters) / static_cast<double>(model.size()), 200);
}

// Forty noisy views of a breathing ball, over and over: the model is complete after a few rounds
// and must then stay as it is. New noise each time would still be the same view.
TEST(Memory, IsFlatOver2000FramesOfTheSameView) {
  const auto surface = [](int k) { return sphere({0, 0, 75 + 0.5 * std::sin(0.157 * k)}, 20); };
  std::vector<Shot> views;
  for (int k = 0; k < 40; ++k) {
    views.push_back(takeShot(surface(k), smallCamera(48, 36),
                             shifted(0.3 * std::sin(0.157 * k), 0.2 * std::cos(0.157 * k), 0)));
    addNoise(static_cast<unsigned>(k), &views.back());
    addWrongPatches(0.05, 6, static_cast<unsigned>(k), &views.back());
  }
  PointModel model;
  InsertionMemory memory;
  std::size_t after_100 = 0, largest = 0;
  long bytes_after_100 = 0;
  for (int k = 0; k < 2000; ++k) {
    const float rise =
        static_cast<float>(0.5 * (std::sin(0.157 * (k % 40)) - std::sin(0.157 * ((k + 39) % 40))));
    for (Eigen::Vector3f& p : model.positions_mm) p.z() += k > 0 ? rise : 0;
    update(views[static_cast<std::size_t>(k % 40)], {}, &memory, &model);
    if (k == 100) after_100 = model.size(), bytes_after_100 = allocated_bytes;
    if (k > 100) largest = std::max(largest, model.size());
    for (const float weight : model.weights) ASSERT_TRUE(weight > 0 && weight <= 10);
  }
  EXPECT_LT(largest, 1.15 * after_100);
  EXPECT_GT(model.size(), 0.9 * after_100);
  EXPECT_LT(allocated_bytes - bytes_after_100,
            63 * 0.3 * after_100);  // a quarter of head room, once
}

}  // namespace
}  // namespace softscope::test
