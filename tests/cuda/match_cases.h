// tests/cuda/match_cases.h: image pairs on which the GPU's matching must give the CPU's bytes.
#pragma once

#include <array>
#include <cstring>
#include <vector>

#include "features/matcher.h"
#include "features/warped_pair.h"

namespace softscope::test {

/// A pair of images and the settings to match it with.
struct MatchCase {
  const char* name;
  int width, height;
  bool anchored, masked;
  MatcherOptions options;
};

inline std::vector<MatchCase> matchCases() {
  MatcherOptions rough, far;
  rough.subpixel.method = "none";
  far.reach = 1;
  far.consistency.max_strain = 0.05;
  return {{"threeLevels", 384, 388, true, true, {}},
          {"oneLevel", 171, 131, false, false, {}},
          {"wholeNodes", 200, 193, false, true, rough},
          {"longReach", 120, 97, true, false, far}};
}

/// A curved texture. Anchored: one part of the model has its first appearance,
/// another has slipped, and a third differs. Dark, masked and untextured parts.
inline WarpedPair pairOf(const MatchCase& of) {
  WarpedPair pair = makeWarpedPair(2.0, of.width, of.height);
  const int width = of.width, height = of.height;
  for (int v = height / 4; v < height / 4 + 12; ++v)
    for (int u = width / 2; u < width / 2 + 30; ++u) pair.model.gray.at(u, v) = 4;
  for (int v = height / 2; v < height / 2 + 30; ++v)
    for (int u = width / 4; u < width / 4 + 40; ++u)
      pair.live.gray.at(u, v) = static_cast<std::uint8_t>(120 + (u + v) % 2);
  if (of.anchored) {
    pair.model.anchor = pair.model.gray;
    for (int v = 0; v < height; ++v)
      for (int u = width / 3; u + 1 < width; ++u)
        pair.model.anchor.at(u, v) = u < 2 * width / 3
                                         ? pair.model.gray.at(u + 1, v)
                                         : static_cast<std::uint8_t>((7 * u + 13 * v) % 251);
  }
  if (of.masked) {
    pair.model.ignore = pair.live.ignore = Mask(width, height, 0);
    for (int v = 20; v < 60; ++v)
      for (int u = 30; u < 70; ++u) pair.model.ignore.at(u, v) = 255;
    for (int v = 60; v < 80; ++v)
      for (int u = 100; u < 140; ++u) pair.live.ignore.at(u, v) = 1;
  }
  return pair;
}

/// How many matches differ in a bit; -1: another number of them.
inline int differingMatches(const std::vector<PixelMatch>& a, const std::vector<PixelMatch>& b) {
  if (a.size() != b.size()) return -1;
  const auto values = [](const PixelMatch& m) {
    return std::array<float, 6>{m.model_px.x(), m.model_px.y(), m.live_px.x(),
                                m.live_px.y(),  m.sigma_px,     m.similarity};
  };
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto x = values(a[i]), y = values(b[i]);
    count += std::memcmp(x.data(), y.data(), sizeof x) != 0;
  }
  return count;
}

}  // namespace softscope::test
