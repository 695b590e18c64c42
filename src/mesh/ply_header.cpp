// src/mesh/ply_header.cpp: format, elements and properties per line.
#include "mesh/ply_header.h"

#include <array>
#include <utility>

#include "core/error.h"
#include "mesh/text_scanner.h"

namespace softscope {
namespace {

PlyType typeOf(std::string_view word, const TextScanner& file) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
      {"char", PlyType::kInt8},
      {"int8", PlyType::kInt8},
      {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16},
      {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},
      {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},
      {"uint", PlyType::kUint32},
      {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat},
      {"float32", PlyType::kFloat},
      {"double", PlyType::kDouble},
      {"float64", PlyType::kDouble},
  }};
  for (const auto& [name, type] : kTypes)
    if (word == name) return type;
  file.fail("found " + TextScanner::shownWord(word) + " where a PLY type is expected");
}

PlyEncoding encodingOf(std::string_view word, const TextScanner& file) {
  if (word == "ascii") return PlyEncoding::kAscii;
  if (word == "binary_little_endian") return PlyEncoding::kLittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::kBigEndian;
  file.fail("the format is " + TextScanner::shownWord(word) +
            ", but ascii, binary_little_endian or binary_big_endian is expected");
}

PlyProperty parseProperty(TextScanner& words, const TextScanner& file) {
  PlyProperty property;
  std::string_view type = words.word();
  if (type == "list") {
    property.is_list = true;
    property.count_type = typeOf(words.word(), file);
    if (property.count_type == PlyType::kFloat || property.count_type == PlyType::kDouble)
      file.fail("a list's length is no whole number");
    type = words.word();
  }
  property.type = typeOf(type, file);
  property.name = words.word();
  return property;
}

void parseLine(std::string_view line, const TextScanner& file, PlyHeader& header) {
  TextScanner words(line, "");
  const std::string_view key = words.word();
  if (key == "format") {
    header.encoding = encodingOf(words.word(), file);
  } else if (key == "element") {
    PlyElement element;
    element.name = words.word();
    element.count = file.toNumber<std::uint64_t>(words.word());
    header.elements.push_back(element);
  } else if (key == "property") {
    if (header.elements.empty()) file.fail("a property precedes the first element");
    header.elements.back().properties.push_back(parseProperty(words, file));
  } else if (key != "comment" && key != "obj_info" && !key.empty()) {
    file.fail("found " + TextScanner::shownWord(key) + " in a PLY header");
  }
}

void requireRoom(const PlyHeader& header, std::size_t left, const std::string& name) {
  for (const PlyElement& element : header.elements)
    if (!element.properties.empty() && element.count > left / element.leastBytes(header.encoding))
      throw InputError(name + ": the header promises " + std::to_string(element.count) + " of " +
                       TextScanner::shownWord(element.name) + ", but only " + std::to_string(left) +
                       " bytes follow; truncated? Then export it again");
}

}  // namespace

int sizeOf(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat:
      return 4;
    case PlyType::kDouble:
      return 8;
  }
  return 0;
}

int PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

std::uint64_t PlyElement::leastBytes(PlyEncoding encoding) const {
  if (encoding == PlyEncoding::kAscii) return properties.size();  // at least one digit each
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : properties)
    bytes += static_cast<std::uint64_t>(sizeOf(p.is_list ? p.count_type : p.type));
  return bytes;
}

PlyHeader parsePlyHeader(std::string_view bytes, const std::string& name) {
  PlyHeader header;
  TextScanner file(bytes, name);
  file.restOfLine();  // ply
  while (true) {
    if (file.position() >= bytes.size()) file.fail("the text ends before `end_header`");
    const TextScanner here = file;
    const std::string_view line = file.restOfLine();
    if (line == "end_header") break;
    parseLine(line, here, header);
  }
  header.bytes = file.position();
  header.lines = file.line() - 1;
  requireRoom(header, bytes.size() - header.bytes, name);
  return header;
}

}  // namespace softscope
