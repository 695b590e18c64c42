#include "io/sequences/video_frame_size.h"

#include <algorithm>

#include "io/text/text_lines.h"

namespace softscope {
namespace {

/// Bits of a parameter set, most significant first; 0 after its end.
class BitReader {
 public:
  explicit BitReader(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const bool emulation = i >= 2 && bytes[i] == 3 && bytes[i - 1] == 0 && bytes[i - 2] == 0;
      if (!emulation) bytes_ += bytes[i];  // ITU-T H.264, 7.4.1
    }
  }

  std::uint32_t bits(int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i, ++at_) {
      const std::size_t byte = at_ / 8;
      const int bit = byte < bytes_.size()
                          ? (static_cast<unsigned char>(bytes_[byte]) >> (7 - at_ % 8)) & 1
                          : 0;
      value = value << 1 | static_cast<std::uint32_t>(bit);
    }
    return value;
  }
  void skip(int count) { at_ += static_cast<std::size_t>(count); }

  /// Unsigned Exponential-Golomb code (H.264, 9.1); the signed code has the same length.
  std::uint32_t golomb() {
    int zeros = 0;
    while (zeros < 31 && bits(1) == 0) ++zeros;
    return (1U << zeros) - 1 + bits(zeros);
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

std::optional<VideoFrameSize> sizeFrom(std::uint64_t width_px, std::uint64_t height_px) {
  constexpr std::uint64_t kLargest = 1 << 16;
  if (width_px == 0 || height_px == 0 || width_px > kLargest || height_px > kLargest)
    return std::nullopt;
  return VideoFrameSize{static_cast<int>(width_px), static_cast<int>(height_px)};
}

/// Size after cropping, given in units of `step_x` and `step_y` px.
std::optional<VideoFrameSize> cropped(std::uint64_t width_px, std::uint64_t height_px,
                                      BitReader& bits, int step_x, int step_y) {
  if (bits.bits(1) == 0) return sizeFrom(width_px, height_px);
  const auto sides = [&bits] { return std::uint64_t{bits.golomb()} + bits.golomb(); };
  const std::uint64_t across_px = sides() * static_cast<unsigned>(step_x);
  const std::uint64_t down_px = sides() * static_cast<unsigned>(step_y);
  if (across_px >= width_px || down_px >= height_px) return std::nullopt;
  return sizeFrom(width_px - across_px, height_px - down_px);
}

// Pixels per chroma sample, by chroma_format_idc: 4:0:0, 4:2:0, 4:2:2, 4:4:4.
constexpr int kChromaWidth[] = {1, 2, 2, 1}, kChromaHeight[] = {1, 2, 1, 1};

void skipScalingLists(BitReader& bits, int count) {
  for (int list = 0; list < count; ++list) {
    if (bits.bits(1) == 0) continue;
    int last = 8, next = 8;
    for (int i = 0; i < (list < 6 ? 16 : 64); ++i) {
      if (next != 0) {
        const std::uint32_t code = bits.golomb();
        const std::int64_t delta =
            code % 2 == 1 ? std::int64_t{code / 2} + 1 : -std::int64_t{code / 2};
        next = static_cast<int>((last + delta + 256) % 256);
      }
      last = next == 0 ? last : next;
    }
  }
}

/// ITU-T H.264, 7.3.2.1.1.
std::optional<VideoFrameSize> sizeOfAvc(std::string_view parameters) {
  BitReader bits(parameters);
  const std::uint32_t profile = bits.bits(8);
  bits.skip(16);
  bits.golomb();  // id
  constexpr std::uint32_t kHighProfiles[] = {100, 110, 122, 244, 44,  83,
                                             86,  118, 128, 138, 139, 134};
  std::uint32_t chroma = 1;
  bool separate_planes = false;
  if (std::find(std::begin(kHighProfiles), std::end(kHighProfiles), profile) !=
      std::end(kHighProfiles)) {
    chroma = bits.golomb();
    if (chroma > 3) return std::nullopt;
    if (chroma == 3) separate_planes = bits.bits(1) == 1;
    bits.golomb();
    bits.golomb();
    bits.skip(1);
    if (bits.bits(1) == 1) skipScalingLists(bits, chroma == 3 ? 12 : 8);
  }
  bits.golomb();
  const std::uint32_t order = bits.golomb();
  if (order == 0) bits.golomb();
  if (order == 1) {
    bits.skip(1);
    bits.golomb();
    bits.golomb();
    const std::uint32_t count = std::min(bits.golomb(), 255U);
    for (std::uint32_t i = 0; i < count; ++i) bits.golomb();
  }
  bits.golomb();
  bits.skip(1);
  const std::uint64_t width_px = 16 * (std::uint64_t{bits.golomb()} + 1);
  const std::uint64_t rows = 16 * (std::uint64_t{bits.golomb()} + 1);
  const int fields = bits.bits(1) == 1 ? 1 : 2;
  if (fields == 2) bits.skip(1);
  bits.skip(1);
  const std::size_t planes = separate_planes ? 0 : chroma;
  return cropped(width_px, rows * static_cast<unsigned>(fields), bits, kChromaWidth[planes],
                 kChromaHeight[planes] * fields);
}

/// ITU-T H.265, 7.3.2.2.1 and 7.3.3.
std::optional<VideoFrameSize> sizeOfHevc(std::string_view parameters) {
  BitReader bits(parameters);
  bits.skip(4);
  const int layers = static_cast<int>(bits.bits(3));
  bits.skip(1 + 96);  // general profile, tier and level
  int skipped = 0;
  for (int layer = 0; layer < layers; ++layer) {
    if (bits.bits(1) == 1) skipped += 88;
    if (bits.bits(1) == 1) skipped += 8;
  }
  if (layers > 0) bits.skip(2 * (8 - layers));
  bits.skip(skipped);
  bits.golomb();
  const std::uint32_t chroma = bits.golomb();
  if (chroma > 3) return std::nullopt;
  if (chroma == 3) bits.skip(1);
  const std::uint32_t width_px = bits.golomb();
  const std::uint32_t height_px = bits.golomb();
  return cropped(width_px, height_px, bits, kChromaWidth[chroma], kChromaHeight[chroma]);
}

/// Payload of the first unit of `type`.
template <class TypeOf>
std::string_view unitOf(std::string_view packet, const TypeOf& is_wanted, std::size_t header) {
  constexpr std::string_view kStart("\0\0\1", 3);
  for (std::size_t at = packet.find(kStart); at != packet.npos; at = packet.find(kStart, at + 3)) {
    if (at + 3 >= packet.size() || !is_wanted(static_cast<unsigned char>(packet[at + 3]))) continue;
    const std::size_t begin = std::min(at + 3 + header, packet.size());
    return packet.substr(begin, packet.find(kStart, begin) - begin);
  }
  return {};
}

/// ITU-T T.81, B.2.2: the frame header.
std::optional<VideoFrameSize> sizeOfJpeg(std::string_view packet) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(packet[at]); };
  for (std::size_t at = 2; at + 9 < packet.size() && byte(at) == 0xff;) {
    const int marker = byte(at + 1);
    const bool frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame)
      return sizeFrom(byte(at + 7) * 256U + byte(at + 8), byte(at + 5) * 256U + byte(at + 6));
    at += 2 + byte(at + 2) * 256U + byte(at + 3);
  }
  return std::nullopt;
}

}  // namespace

std::optional<VideoFrameSize> statedFrameSize(std::string_view packet, const std::string& codec) {
  const std::string name = lowerCase(codec);
  if (name == "mjpg" || name == "jpeg") return sizeOfJpeg(packet);
  if (name == "h264" || name == "avc1" || name == "avc3" || name == "x264") {
    const std::string_view unit = unitOf(
        packet, [](unsigned char header) { return (header & 0x1f) == 7; }, 1);
    return unit.empty() ? std::nullopt : sizeOfAvc(unit);
  }
  if (name == "hevc" || name == "hvc1" || name == "hev1" || name == "h265") {
    const std::string_view unit = unitOf(
        packet, [](unsigned char header) { return (header >> 1 & 0x3f) == 33; }, 2);
    return unit.empty() ? std::nullopt : sizeOfHevc(unit);
  }
  return std::nullopt;
}

}  // namespace softscope
