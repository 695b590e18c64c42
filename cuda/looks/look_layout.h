// cuda/looks/look_layout.h: first looks, the image in which they are sought, and where they are
// found.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cuda/device/arena.h"
#include "features/look_formulas.h"

namespace softscope::cuda {

/// The bytes of a FirstLook.
struct LookBytes {
  struct OfLevel {
    std::uint8_t gray[kLookPixels], ignore[kLookPixels], taken, unused;
  };
  OfLevel levels[kLookLevels];
  std::uint8_t unused[4];
};

/// One size of the image; the mask is null where nothing is ignored.
struct LookImageLevel {
  const std::uint8_t *gray, *ignore;
  int width, height;
};
struct LookImageLevels {
  LookImageLevel at[kLookLevels];
};

struct LookQuestion {
  LookPlace expected;
  std::int32_t number;  // of the look
  std::int32_t unused;
};

struct LookLayout {
  LookLayout() = default;
  LookLayout(Arena& arena, std::size_t count)
      : looks(arena.array<LookBytes>(count)),
        questions(arena.array<LookQuestion>(count)),
        finds(arena.array<LookFind>(count)) {}

  LookBytes* looks = nullptr;  // by their numbers
  LookQuestion* questions = nullptr;
  LookFind* finds = nullptr;
};

/// The image at full size, where it isn't on the device already, and at half and quarter size.
struct LookPictureLayout {
  LookPictureLayout() = default;
  LookPictureLayout(Arena& arena, int width, int height) {
    for (int level = 0; level < kLookLevels; ++level) {
      gray[level] = arena.image<std::uint8_t>(width >> level, height >> level);
      ignore[level] = arena.image<std::uint8_t>(width >> level, height >> level);
    }
  }

  View<std::uint8_t> gray[kLookLevels], ignore[kLookLevels];
};

}  // namespace softscope::cuda
