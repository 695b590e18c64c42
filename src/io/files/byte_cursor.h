// src/io/files/byte_cursor.h: bounds-checked reading of numbers from bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"

namespace softscope {

class ByteCursor {
 public:
  /// `name` is used in errors.
  ByteCursor(std::string_view bytes, std::string name, bool big_endian)
      : bytes_(bytes), name_(std::move(name)), big_endian_(big_endian) {}

  std::size_t position() const { return next_; }
  std::size_t left() const { return bytes_.size() - next_; }
  const std::string& name() const { return name_; }

  [[noreturn]] void failTruncated() const {
    throw InputError(name_ + ": the file is truncated. Copy or export it again.");
  }
  [[noreturn]] void failDamaged(const char* what) const {
    throw InputError(name_ + ": the file is damaged (" + what + "). Copy or export it again.");
  }

  void moveTo(std::size_t position) {
    if (position > bytes_.size()) failTruncated();
    next_ = position;
  }
  std::string_view take(std::size_t count) {
    if (count > left()) failTruncated();
    const std::string_view out = bytes_.substr(next_, count);
    next_ += count;
    return out;
  }
  std::uint8_t u8() { return static_cast<std::uint8_t>(take(1)[0]); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(unsignedNumber(2)); }
  std::uint32_t u32() { return unsignedNumber(4); }
  std::int32_t i32() { return static_cast<std::int32_t>(unsignedNumber(4)); }

 private:
  std::uint32_t unsignedNumber(int count) {
    const std::string_view raw = take(static_cast<std::size_t>(count));
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
      const int from = big_endian_ ? i : count - 1 - i;
      value = value << 8 | static_cast<std::uint8_t>(raw[static_cast<std::size_t>(from)]);
    }
    return value;
  }

  std::string_view bytes_;
  std::string name_;
  bool big_endian_;
  std::size_t next_ = 0;
};

}  // namespace softscope
