// vtk_views/files/packed_bytes.h: binary
// serialisation between processes of one program.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"

namespace softscope {

/// Appends values to `bytes`.
class BytePacker {
 public:
  std::string bytes;

  template <class Value>
  void add(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void addText(std::string_view text) {
    add(text.size());
    bytes.append(text);
  }
  /// Elements of plain numbers without padding: Eigen's fixed vectors, arrays, numbers.
  template <class Value>
  void addAll(const std::vector<Value>& values) {
    addText({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
  }
};

/// Reads them in the same order. Throws Error for missing bytes.
class ByteUnpacker {
 public:
  explicit ByteUnpacker(std::string_view bytes) : rest_(bytes) {}

  template <class Value>
  void take(Value& value) {
    std::memcpy(&value, next(sizeof value).data(), sizeof value);
  }
  void takeText(std::string& text) {
    std::size_t length = 0;
    take(length);
    text = next(length);
  }
  template <class Value>
  void takeAll(std::vector<Value>& values) {
    std::size_t length = 0;
    take(length);
    const std::string_view from = next(length);
    values.resize(length / sizeof(Value));
    if (length > 0) std::memcpy(static_cast<void*>(values.data()), from.data(), length);
  }

 private:
  std::string_view next(std::size_t length) {
    if (length > rest_.size()) throw Error("the answer of a reading process is cut short");
    const std::string_view part = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return part;
  }

  std::string_view rest_;
};

}  // namespace softscope
