// cuda/looks/looks_run.h: memory, copies and launches of the search of first looks, on any machine.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "cuda/device/grown_memory.h"
#include "cuda/looks/look_search.h"
#include "cuda/looks/looks.h"

namespace softscope::cuda {

static_assert(sizeof(LookBytes) == sizeof(FirstLook));

/// Machine: as WarpRun has it.
template <class Machine>
class LooksRun final : public LookFinder {
 public:
  template <class... Arguments>
  explicit LooksRun(Arguments&&... arguments) : machine_(std::forward<Arguments>(arguments)...) {}

  void forget() override { is_there_.clear(); }

  std::vector<FoundLook> find(const std::vector<SoughtLook>& sought, const GrayImage& image,
                              const Mask& ignore, const SharedRasters* rasters) override {
    if (sought.empty()) return {};
    const LookImageLevels levels = bringImage(image, ignore, rasters);
    bringLooks(sought);
    std::vector<LookQuestion> questions;
    for (const SoughtLook& one : sought)
      questions.push_back({placeOf(one.pixel, one.image_from_look), one.number, 0});
    machine_.toDevice(layout_.questions, questions.data(), questions.size() * sizeof(LookQuestion));
    machine_.executor().launch(
        "search looks", SearchLookKernel{layout_.looks, layout_.questions, levels, layout_.finds},
        Grid{static_cast<int>(sought.size()), 1, 1});
    std::vector<LookFind> finds(sought.size());
    machine_.fromDevice(finds.data(), layout_.finds, finds.size() * sizeof(LookFind));
    machine_.wait();
    std::vector<FoundLook> found(sought.size());
    std::transform(
        finds.begin(), finds.end(), sought.begin(), found.begin(),
        [](const LookFind& find, const SoughtLook& one) { return foundLook(find, one.pixel); });
    return found;
  }

 private:
  using Memory = typename Machine::Memory;
  static constexpr const char* kWhat = "memory for first looks";

  /// At all sizes.
  LookImageLevels bringImage(const GrayImage& image, const Mask& ignore,
                             const SharedRasters* rasters) {
    const int width = image.width_px, height = image.height_px;
    Arena counting;
    const LookPictureLayout planned(counting, width, height);
    growTo(counting.bytes(), kWhat, &picture_memory_);
    Arena arena(picture_memory_.data());
    const LookPictureLayout own(arena, width, height);
    const bool ignores = !ignore.empty();
    LookImageLevels levels{};
    levels.at[0] = {own.gray[0].data, ignores ? own.ignore[0].data : nullptr, width, height};
    if (rasters != nullptr) {
      levels.at[0].gray = rasters->match_gray;
      levels.at[0].ignore = rasters->ignore;
    } else {
      machine_.toDevice(own.gray[0].data, image.values.data(), image.size());
      if (ignores) machine_.toDevice(own.ignore[0].data, ignore.values.data(), ignore.size());
    }
    for (int level = 1; level < kLookLevels; ++level) {
      const LookImageLevel& fine = levels.at[level - 1];
      const HalveLookBody halve{{fine.gray, fine.width, fine.height, fine.width},
                                {fine.ignore, fine.width, fine.height, fine.width},
                                own.gray[level],
                                own.ignore[level]};
      const PixelKernel<HalveLookBody> kernel{halve, own.gray[level].width, own.gray[level].height};
      machine_.executor().launch("halve", kernel, kernel.grid());
      levels.at[level] = {own.gray[level].data,
                          fine.ignore == nullptr ? nullptr : own.ignore[level].data,
                          own.gray[level].width, own.gray[level].height};
    }
    return levels;
  }

  /// Those that aren't there yet.
  void bringLooks(const std::vector<SoughtLook>& sought) {
    std::size_t count = sought.size();
    for (const SoughtLook& one : sought)
      count = std::max(count, static_cast<std::size_t>(one.number) + 1);
    reserve(count);
    is_there_.resize(capacity_, false);
    for (const SoughtLook& one : sought) {
      const std::size_t number = static_cast<std::size_t>(one.number);
      if (is_there_[number]) continue;
      machine_.toDevice(layout_.looks + number, one.look, sizeof(LookBytes));
      is_there_[number] = true;
    }
  }
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    is_there_.clear();
    capacity_ = 0;
    Arena counting;
    const LookLayout planned(counting, count);
    growTo(counting.bytes(), kWhat, &memory_);
    Arena arena(memory_.data());
    layout_ = LookLayout(arena, count);
    capacity_ = count;
  }

  Memory memory_, picture_memory_;
  Machine machine_;
  LookLayout layout_;
  std::size_t capacity_ = 0;
  std::vector<bool> is_there_;
};

}  // namespace softscope::cuda
