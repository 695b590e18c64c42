#include "vtk_views/volumes/voxel_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <vector>

#include "core/error.h"
#include "core/guarded_read.h"

namespace softscope {
namespace {

constexpr int kZlibOrGzip = 15 + 32;        // windowBits: detected from the first bytes
constexpr double kMostDeflateRatio = 1040;  // 1032, with a margin for short streams
constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

double lengthOf(const VoxelBlock& block) {
  return block.voxels * block.components * double(bytesOf(block.type));
}

std::string bytesText(double bytes) {
  std::string text = std::to_string(std::llround(std::min(bytes, 9e18)));
  return (bytes > 9e18 ? "more than " : "") + text + " bytes";
}

[[noreturn]] void failShort(const VoxelBlock& block, const std::string& found) {
  throw InputError(block.file.string() + ": is cut short: its header's sizes and type need " +
                   bytesText(lengthOf(block)) + " of voxels, but " + found + ". Copy it again");
}

[[noreturn]] void failLong(const VoxelBlock& block, const std::string& found) {
  throw InputError(block.file.string() + ": its header's sizes and type need " +
                   bytesText(lengthOf(block)) + " of voxels, but " + found +
                   ". A size or type in the header is damaged; export it again");
}

[[noreturn]] void failDamaged(const VoxelBlock& block) {
  throw InputError(block.file.string() +
                   ": its compressed voxels are damaged: they don't unpack, or not to their check "
                   "sum. Copy it again");
}

/// Decompresses a stream in pieces; several gzip members count as one.
class Unpacker {
 public:
  Unpacker(const std::filesystem::path& path, std::uintmax_t offset)
      : file_(path, std::ios::binary), packed_(kPieceBytes) {
    file_.seekg(static_cast<std::streamoff>(offset));
    if (!file_ || inflateInit2(&stream_, kZlibOrGzip) != Z_OK)
      throw InputError(path.string() + ": can't be opened; check its rights");
  }
  ~Unpacker() { inflateEnd(&stream_); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// Up to `count` bytes; fewer at the end, or for a damaged stream.
  std::size_t read(char* bytes, std::size_t count) {
    std::size_t done = 0;
    while (done < count && !damaged_ && !ended_) {
      const std::size_t piece = std::min(count - done, std::size_t{1} << 30);
      stream_.next_out = reinterpret_cast<Bytef*>(bytes + done);
      stream_.avail_out = static_cast<uInt>(piece);
      step();
      done += piece - stream_.avail_out;
    }
    return done;
  }
  bool damaged() const { return damaged_; }
  /// The whole stream was read and its checksum is valid.
  bool complete() const { return ended_ && !damaged_; }
  /// The stream is followed by further bytes.
  bool followed() const { return followed_; }

 private:
  void step() {
    if (stream_.avail_in == 0) refill();
    if (stream_.avail_in == 0) {
      damaged_ = true;  // the file ends within the stream
      return;
    }
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_STREAM_END)
      endMember();
    else if (result != Z_OK && result != Z_BUF_ERROR)
      damaged_ = true;
  }
  void endMember() {
    if (stream_.avail_in == 0) refill();
    ended_ = true;
    if (stream_.avail_in == 0) return;
    followed_ = stream_.next_in[0] != 0x1f;
    if (followed_) return;
    ended_ = inflateReset(&stream_) != Z_OK;
  }
  void refill() {
    file_.read(packed_.data(), static_cast<std::streamsize>(packed_.size()));
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(file_.gcount());
  }

  std::ifstream file_;
  std::vector<char> packed_;
  z_stream stream_{};
  bool damaged_ = false, ended_ = false, followed_ = false;
};

bool machineIsBigEndian() {
  const std::uint16_t one = 1;
  return *reinterpret_cast<const char*>(&one) == 0;
}

std::string inMachineOrder(const VoxelBlock& block, std::string bytes) {
  const std::size_t width = bytesOf(block.type);
  if (width > 1 && block.big_endian != machineIsBigEndian())
    for (std::size_t at = 0; at + width <= bytes.size(); at += width)
      std::reverse(bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at + width));
  return bytes;
}

std::uintmax_t sizeFrom(const VoxelBlock& block) {
  requireRegularFile(block.file);
  const std::uintmax_t size = std::filesystem::file_size(block.file);
  return size - std::min(size, block.offset);
}

/// Skips `skip` bytes of the decompressed stream, then reads all voxels.
std::string unpackExactly(const VoxelBlock& block, std::uintmax_t stream_at, std::uintmax_t skip) {
  requireRegularFile(block.file);
  const auto packed = static_cast<double>(std::filesystem::file_size(block.file));
  const double length = lengthOf(block);
  if (length > packed * kMostDeflateRatio)
    failShort(block, bytesText(packed) + " on disk can't hold them");
  Unpacker unpacker(block.file, stream_at);
  std::array<char, 4096> skipped{};
  for (std::uintmax_t left = skip; left > 0;) {
    const std::size_t count =
        unpacker.read(skipped.data(), std::size_t(std::min<std::uintmax_t>(left, skipped.size())));
    if (count == 0) break;
    left -= count;
  }
  std::string bytes(static_cast<std::size_t>(length), '\0');
  const std::size_t count = unpacker.read(bytes.data(), bytes.size());
  if (unpacker.damaged()) failDamaged(block);
  if (count < bytes.size()) failShort(block, "unpacked they are " + bytesText(double(count)));
  char more = 0;
  if (unpacker.read(&more, 1) > 0) failLong(block, "unpacked they are more");
  if (!unpacker.complete()) failDamaged(block);
  if (unpacker.followed()) failLong(block, "other bytes follow them");
  return inMachineOrder(block, std::move(bytes));
}

}  // namespace

std::string readPlainVoxels(const VoxelBlock& block) {
  const std::uintmax_t there = sizeFrom(block);
  const double length = lengthOf(block);
  if (double(there) < length) failShort(block, "there are " + bytesText(double(there)));
  if (double(there) > length) failLong(block, "there are " + bytesText(double(there)));
  std::string bytes(static_cast<std::size_t>(length), '\0');
  std::ifstream file(block.file, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(block.offset));
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw InputError(block.file.string() + ": can't be read; check its rights");
  return inMachineOrder(block, std::move(bytes));
}

std::string readPackedVoxels(const VoxelBlock& block) {
  return unpackExactly(block, block.offset, 0);
}

std::string readGzippedVoxels(const VoxelBlock& block) {
  return unpackExactly(block, 0, block.offset);
}

bool isGzip(const std::filesystem::path& path) {
  requireRegularFile(path);
  char head[2] = {};
  std::ifstream(path, std::ios::binary).read(head, 2);
  return head[0] == '\x1f' && head[1] == '\x8b';
}

std::string firstBytes(const std::filesystem::path& path, std::size_t count) {
  std::string bytes(count, '\0');
  if (!isGzip(path)) {
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
  }
  bytes.resize(Unpacker(path, 0).read(bytes.data(), count));
  return bytes;
}

}  // namespace softscope
