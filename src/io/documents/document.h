// src/io/documents/document.h: a YAML, XML or JSON document as one tree.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace softscope {

/// Tree of texts. Numbers are parsed on access.
struct Document {
  enum class Kind { kText, kList, kMap };

  Kind kind = Kind::kText;
  std::string text;                                       // kText; empty for null
  std::vector<Document> items;                            // kList
  std::vector<std::pair<std::string, Document>> members;  // kMap, in the order of the file

  /// Member of a map, null if absent.
  const Document* find(std::string_view key) const;
};

/// Nesting limit, which protects the stack; no supported file nests deeper.
inline constexpr int kDeepestNesting = 40;

/// Throws InputError for a duplicate key with different values. Called by the parsers below.
void requireUniqueKeys(const Document& document, const std::string& name);

/// Subset of YAML written by OpenCV, ROS and Python: maps and lists by indentation
/// or in brackets; tags and comments are skipped; no anchors, no folded texts.
/// `name` is used in errors. All throw InputError with the line of the error.
Document parseYaml(std::string_view text, const std::string& name);

/// XML of OpenCV: elements become maps, repeated ones lists;
/// attributes are skipped. Returns the content of the root element.
Document parseXml(std::string_view text, const std::string& name);

Document parseJson(std::string_view text, const std::string& name);

/// Any of the three formats, detected from the first character.
Document parseDocument(std::string_view text, const std::string& name);

}  // namespace softscope
