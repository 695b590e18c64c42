// src/io/documents/document.h: a YAML, XML or JSON document as one tree.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace softscope {

/// A tree of texts. Numbers stay text until they are asked for.
struct Document {
  enum class Kind { kText, kList, kMap };

  Kind kind = Kind::kText;
  std::string text;                                       // kText; empty for "nothing"
  std::vector<Document> items;                            // kList
  std::vector<std::pair<std::string, Document>> members;  // kMap, in the file's order

  /// The member of a map, null where there is none.
  const Document* find(std::string_view key) const;
};

/// No file that we read nests deeper; more is refused, so that the stack holds.
inline constexpr int kDeepestNesting = 40;

/// Throws InputError where a map has a key twice with different values. The readers below call it.
void requireUniqueKeys(const Document& document, const std::string& name);

/// The part of YAML that OpenCV, ROS and Python write: maps and lists by indentation or in
/// brackets, tags and comments skipped; no anchors, no folded texts.
/// `name` is what errors call the file. All throw InputError with the line where reading stopped.
Document parseYaml(std::string_view text, const std::string& name);

/// OpenCV's XML: elements become maps, repeated ones lists; attributes are skipped.
/// Returns what the root element holds.
Document parseXml(std::string_view text, const std::string& name);

Document parseJson(std::string_view text, const std::string& name);

/// Any of the three, told apart by the first character.
Document parseDocument(std::string_view text, const std::string& name);

}  // namespace softscope
