// vtk_views/volumes/header_text.h: text header of a MetaImage or NRRD file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace softscope {

/// Fields of a header, each at most once. All functions
/// throw InputError with the file, the field and its value.
class HeaderText {
 public:
  /// Lines "key = value", including `last_key`.
  static HeaderText readMetaImage(const std::string& path, const std::string& last_key);
  /// Lines "key: value" after the magic, up to an empty line or the end, keys in
  /// lower case; comments are skipped; of notes "key:=value" the keys are kept.
  static HeaderText readNrrd(const std::string& path);

  const std::string& path() const { return path_; }
  /// Offset of the voxels in the same file.
  std::uintmax_t endOffset() const { return end_offset_; }
  bool has(const std::string& key) const { return fields_.count(key) > 0; }
  /// First of these names in the header; empty if absent.
  std::string firstOf(std::initializer_list<const char*> keys) const;
  const std::string& text(const std::string& key) const;
  std::string textOr(const std::string& key, const std::string& otherwise) const;
  /// Exactly `count` finite numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  /// Exactly `count` integers from `least` to `most`.
  std::vector<std::int64_t> wholes(const std::string& key, std::size_t count, std::int64_t least,
                                   std::int64_t most) const;
  bool flagOr(const std::string& key, bool otherwise) const;

  /// Names that are neither in `read` nor in `harmless`. Throws for a name
  /// similar to one of `read`, whose value would otherwise be the default.
  std::vector<std::string> unknownKeys(const std::vector<std::string>& read,
                                       const std::vector<std::string>& harmless) const;
  /// Throws for a name that is not in `known`, and for a note "key:=value" named like a field.
  void requireKnownKeys(const std::vector<std::string>& known) const;

  /// InputError with the file, the key, its value, and the fault.
  [[noreturn]] void fail(const std::string& key, const std::string& complaint) const;

 private:
  void add(const std::string& key, const std::string& value);

  std::string path_;
  std::uintmax_t end_offset_ = 0;
  std::map<std::string, std::string> fields_;
  std::set<std::string> notes_;
};

/// Finite numbers of "1 0 0"; commas count as spaces. Empty if a word is not a number.
std::vector<double> finiteNumbers(std::string text);

/// Value of a header in a message: in quotes, at most 60 characters, unprintable ones as `?`.
std::string inQuotes(const std::string& text);

}  // namespace softscope
