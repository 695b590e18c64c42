// cuda/device/host_executor.h: runs kernel bodies on the host, blocks and threads in shuffled
// orders, so that tests without a GPU cover what kernels compute.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "cuda/device/kernel.h"

namespace softscope::cuda {

template <class Kernel, class = void>
struct RepeatsOf {
  SOFTSCOPE_HD static int of(const Kernel&, const Place&) { return 1; }
};
template <class Kernel>
struct RepeatsOf<Kernel, std::void_t<decltype(&Kernel::repeats)>> {
  SOFTSCOPE_HD static int of(const Kernel& kernel, const Place& at) { return kernel.repeats(at); }
};

template <class Kernel, class = void>
struct EndOf {
  SOFTSCOPE_HD static bool isOver(const Kernel&, const typename Kernel::Shared&) { return false; }
};
template <class Kernel>
struct EndOf<Kernel, std::void_t<decltype(&Kernel::isOver)>> {
  SOFTSCOPE_HD static bool isOver(const Kernel& kernel, const typename Kernel::Shared& shared) {
    return kernel.isOver(shared);
  }
};

/// Shared memory is initialised with garbage, as on the device. Different
/// results for two seeds show a race, or a dependence on the order of blocks.
class HostExecutor {
 public:
  explicit HostExecutor(unsigned seed = 1) : random_(seed) {}

  template <class Kernel>
  void launch(const char* /*name*/, const Kernel& kernel, Grid grid) {
    std::vector<int> blocks = shuffled(grid.x * grid.y * grid.z);
    const auto shared = std::make_unique<typename Kernel::Shared>();
    std::vector<typename Kernel::Local> locals(Kernel::kThreads);
    for (const int block : blocks) {
      std::memset(static_cast<void*>(shared.get()), 0xA5, sizeof *shared);
      Place at{block % grid.x, block / grid.x % grid.y, block / grid.x / grid.y, 0, 0, grid};
      const int repeats = RepeatsOf<Kernel>::of(kernel, at);
      for (at.repeat = 0; at.repeat < repeats; ++at.repeat) {
        if (at.repeat > 0 && EndOf<Kernel>::isOver(kernel, *shared)) break;
        runPhases(kernel, at, *shared, locals, std::make_integer_sequence<int, Kernel::kPhases>());
      }
    }
  }

  void mark(const char* /*stage*/) {}

 private:
  std::vector<int> shuffled(int count) {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random_);
    return order;
  }
  template <class Kernel, int... kPhase>
  void runPhases(const Kernel& kernel, const Place& at, typename Kernel::Shared& shared,
                 std::vector<typename Kernel::Local>& locals,
                 std::integer_sequence<int, kPhase...>) {
    (runPhase<kPhase>(kernel, at, shared, locals), ...);
  }
  template <int kPhase, class Kernel>
  void runPhase(const Kernel& kernel, Place at, typename Kernel::Shared& shared,
                std::vector<typename Kernel::Local>& locals) {
    // A rotation with a random odd stride: sufficient for finding races, and fast.
    const unsigned count = static_cast<unsigned>(Kernel::kThreads);
    const unsigned first = random_() % count, step = random_() % count | 1u;
    static_assert((Kernel::kThreads & (Kernel::kThreads - 1)) == 0, "a power of two");
    for (unsigned i = 0; i < count; ++i) {
      at.thread = static_cast<int>((first + i * step) % count);
      kernel.template run<kPhase>(at, shared, locals[static_cast<std::size_t>(at.thread)]);
    }
  }

  std::mt19937 random_;
};

}  // namespace softscope::cuda
