#include "io/documents/npy_file.h"

#include <cstdint>
#include <cstring>

#include "core/decimal_number.h"
#include "core/error.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMostNumbers = 10'000'000;

struct NpyHeader {
  std::string_view text;
  std::size_t data_begin = 0;
};

NpyHeader npyHeaderOf(std::string_view bytes, const std::string& name) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  const std::size_t length_bytes = bytes.size() > 6 && bytes[6] == 1 ? 2 : 4;
  const std::size_t begin = 8 + length_bytes;
  if (!isNpy(bytes) || bytes.size() < begin)
    throw InputError(name + ": not a NumPy file. Save it with numpy.save.");
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) length |= std::size_t{byte(8 + i)} << (8 * i);
  if (length > bytes.size() - begin)
    throw InputError(name + ": ends inside its header. Copy it again.");
  return {bytes.substr(begin, length), begin + length};
}

/// Text after 'key': in the dictionary of the header.
std::string_view entry(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  const std::size_t colon = header.find(':', at);
  return colon == std::string_view::npos ? std::string_view{} : trimmed(header.substr(colon + 1));
}

/// The two numbers of "(63, 17)".
bool readShape(std::string_view text, NpyArray& out) {
  if (text.empty() || text.front() != '(') return false;
  const std::size_t end = text.find(')');
  if (end == std::string_view::npos) return false;
  const auto words = wordsOf(text.substr(1, end - 1));
  if (words.size() != 2) return false;
  const auto number = [](std::string_view word, std::size_t& value) {
    const auto whole = decimalNumber<std::size_t>(word);
    value = whole.value_or(0);
    return whole.has_value();
  };
  return number(words[0], out.rows) && number(words[1], out.columns) && out.rows > 0 &&
         out.columns > 0 && out.rows <= kMostNumbers / out.columns;
}

template <class T>
void copyValues(std::string_view data, std::vector<double>& out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    T value;
    std::memcpy(&value, data.data() + i * sizeof(T), sizeof(T));
    out[i] = static_cast<double>(value);
  }
}

}  // namespace

std::string npyBytes(const Raster<float>& values) {
  std::string header = say("{'descr': '<f4', 'fortran_order': False, 'shape': (", values.height_px,
                           ", ", values.width_px, "), }");
  constexpr std::size_t kBegin = 10, kAlignment = 64;  // of the header's first part; of the data
  header.append(kAlignment - 1 - (kBegin + header.size()) % kAlignment, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff),
            static_cast<char>(header.size() >> 8)};
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(values.values.data()),
               values.values.size() * sizeof(float));
  return bytes;
}

bool isNpy(std::string_view bytes) { return bytes.substr(0, kMagic.size()) == kMagic; }

NpyArray parseNpy(std::string_view bytes, const std::string& name) {
  const NpyHeader header = npyHeaderOf(bytes, name);
  const std::string_view type = entry(header.text, "'descr'").substr(0, 5);
  const bool is_double = type == "'<f8'";
  NpyArray out;
  if ((!is_double && type != "'<f4'") ||
      entry(header.text, "'fortran_order'").substr(0, 5) != "False" ||
      !readShape(entry(header.text, "'shape'"), out))
    throw InputError(say(name, ": its header is ", excerpt(header.text),
                         ", but a table of <f4 or <f8 in C order is expected."));
  const std::size_t needed = out.rows * out.columns * (is_double ? 8 : 4);
  const std::string_view data = bytes.substr(header.data_begin);
  if (data.size() < needed)
    throw InputError(say(name, ": has ", data.size(), " bytes of numbers, but its header promises ",
                         needed, ". Copy it again."));
  out.values.resize(out.rows * out.columns);
  is_double ? copyValues<double>(data, out.values) : copyValues<float>(data, out.values);
  return out;
}

}  // namespace softscope
