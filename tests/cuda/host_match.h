// tests/cuda/host_match.h: the kernels of matching, run by the host executor.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cuda/device/host_executor.h"
#include "cuda/match/match_passes.h"
#include "host_memory.h"

namespace softscope::test {

class HostMatch {
 public:
  HostMatch(const MatcherOptions& options, int width, int height, unsigned seed)
      : executor_(seed),
        memory_(bytesFor(options, width, height)),
        arena_(memory_.data()),
        layout_(arena_, options, width, height),
        passes_(executor_, layout_) {}

  std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) {
    const cuda::MatchScale& full = layout_.levels.front();
    *layout_.inputs = {model.anchor.empty() ? 0 : 1,
                       {model.ignore.empty() ? 0 : 1, live.ignore.empty() ? 0 : 1}};
    copy(model.gray, full.gray[0].data);
    copy(live.gray, full.gray[1].data);
    copy(model.anchor, full.gray[2].data);
    copy(model.ignore, layout_.mask[0].data);
    copy(live.ignore, layout_.mask[1].data);
    passes_.match();
    return cuda::pixelMatches(layout_.list, *layout_.match_count);
  }
  const cuda::MatchLayout& layout() const { return layout_; }

 private:
  static void copy(const Raster<std::uint8_t>& from, std::uint8_t* to) {
    std::copy(from.values.begin(), from.values.end(), to);
  }
  static std::size_t bytesFor(const MatcherOptions& options, int width, int height) {
    cuda::Arena counting;
    cuda::MatchLayout(counting, options, width, height);
    return counting.bytes();
  }

  cuda::HostExecutor executor_;
  HostMemory memory_;
  cuda::Arena arena_;
  cuda::MatchLayout layout_;
  cuda::MatchPasses<cuda::HostExecutor> passes_;
};

}  // namespace softscope::test
