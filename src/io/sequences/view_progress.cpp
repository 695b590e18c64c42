#include "io/sequences/view_progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "io/text/message.h"

namespace softscope {
namespace {

constexpr std::uint64_t kDigestPrime = 0x100000001b3;  // of FNV-1a, here over words of 8 bytes

std::uint64_t mixed(std::uint64_t digest, std::uint64_t word) {
  digest = (digest ^ word) * kDigestPrime;
  return digest ^ digest >> 32;
}

/// Four digests of every fourth word, which a processor computes in parallel.
std::uint64_t digestOfBytes(const ColourImage& image) {
  using Words = std::array<std::uint64_t, 4>;
  const auto* bytes = reinterpret_cast<const unsigned char*>(image.values.data());
  const std::size_t count = image.size() * sizeof(Rgb8);
  Words lanes{1, 2, 3, 4}, words{};
  for (std::size_t begin = 0; begin < count; begin += sizeof words) {
    words = {};
    std::memcpy(words.data(), bytes + begin, std::min(sizeof words, count - begin));
    for (std::size_t i = 0; i < lanes.size(); ++i) lanes[i] = mixed(lanes[i], words[i]);
  }
  return mixed(mixed(lanes[0], lanes[1]), mixed(lanes[2], lanes[3]));
}

constexpr int kRowStep = 4;  // every fourth row tells enough
constexpr float kMovesGray = 1;

ViewDigest::Parts partsOf(const ColourImage& image) {
  constexpr int kAcross = ViewDigest::kPartsAcross, kDown = ViewDigest::kPartsDown;
  ViewDigest::Parts sums{}, counts{};
  for (int v = 0; v < image.height_px; v += kRowStep)
    for (int u = 0; u < image.width_px; ++u) {
      const int part = v * kDown / image.height_px * kAcross + u * kAcross / image.width_px;
      sums[static_cast<std::size_t>(part)] += image.at(u, v).green;
      counts[static_cast<std::size_t>(part)] += 1;
    }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 0) sums[i] /= counts[i];
  return sums;
}

ViewDigest digestOfView(const ColourImage& image) { return {digestOfBytes(image), partsOf(image)}; }

/// Whether two images of one camera show different things.
bool showsMotion(const ViewDigest& before, const ViewDigest& now) {
  for (std::size_t i = 0; i < now.brightness.size(); ++i)
    if (std::abs(now.brightness[i] - before.brightness[i]) >= kMovesGray) return true;
  return false;
}

bool isFlat(const ColourImage& image) {
  return std::all_of(image.values.begin(), image.values.end(),
                     [&](const Rgb8& colour) { return colour == image.values.front(); });
}

/// "right (000005.png)"; "right" for both views in one file.
std::string viewNamed(const char* side, const std::string& file) {
  return file.empty() ? say("the ", side, " image") : say("the ", side, " image (", file, ")");
}

}  // namespace

PairDigest digestOf(const StereoPair& pair) {
  return {digestOfView(pair.left), digestOfView(pair.right), isFlat(pair.left)};
}

std::string viewProgressFault(const std::optional<EarlierPair>& before, const PairDigest& now,
                              const FrameNames& names) {
  const std::string left = viewNamed("left", names.right.empty() ? "" : names.left);
  const std::string right = viewNamed("right", names.right);
  if (now.left.bytes == now.right.bytes && !now.left_is_flat)
    return say(left, " and ", right, " are equal, but two views of a scene differ: one view was ",
               "given or recorded twice. Give the left and the right one.");
  if (!before) return {};
  const bool left_stands = now.left.bytes == before->digest.left.bytes;
  const bool right_stands = now.right.bytes == before->digest.right.bytes;
  if (left_stands == right_stands) return {};
  if (right_stands ? !showsMotion(before->digest.left, now.left)
                   : !showsMotion(before->digest.right, now.right))
    return {};
  return say(right_stands ? right : left, " is that of frame ", before->frame, ", the ",
             right_stands ? "left" : "right",
             " one is not: the recording of one view stands still. Record or export both views "
             "again, or select other frames with `frames=`.");
}

bool repeats(const PairDigest& before, const PairDigest& now) {
  return now.left.bytes == before.left.bytes && now.right.bytes == before.right.bytes;
}

EarlierPair asEarlier(const std::optional<EarlierPair>& before, int frame, const PairDigest& now) {
  EarlierPair earlier{frame, now};
  if (!before) return earlier;
  if (now.right.bytes == before->digest.right.bytes)
    earlier.digest.left.brightness = before->digest.left.brightness;
  if (now.left.bytes == before->digest.left.bytes)
    earlier.digest.right.brightness = before->digest.right.brightness;
  return earlier;
}

}  // namespace softscope
