// vtk_views/volumes/header_text.h: lines of text before the voxels of a MetaImage or NRRD file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace softscope {

/// The fields of a header, each once. All functions throw InputError that names the file, the field
/// and what it holds.
class HeaderText {
 public:
  /// Lines "key = value" up to and with `last_key`.
  static HeaderText readMetaImage(const std::string& path, const std::string& last_key);
  /// Lines "key: value" after the magic, up to an empty line or the end, keys in small letters;
  /// comments are skipped, and of notes "key:=value" the keys kept.
  static HeaderText readNrrd(const std::string& path);

  const std::string& path() const { return path_; }
  /// Where the voxels of the same file begin.
  std::uintmax_t endOffset() const { return end_offset_; }
  bool has(const std::string& key) const { return fields_.count(key) > 0; }
  /// The first of these names that the header has; empty where it has none.
  std::string firstOf(std::initializer_list<const char*> keys) const;
  const std::string& text(const std::string& key) const;
  std::string textOr(const std::string& key, const std::string& otherwise) const;
  /// Finite numbers, exactly so many.
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  /// Whole numbers from `least` to `most`, exactly so many.
  std::vector<std::int64_t> wholes(const std::string& key, std::size_t count, std::int64_t least,
                                   std::int64_t most) const;
  bool flagOr(const std::string& key, bool otherwise) const;

  /// Names that are none of `read` and none of `harmless`. Throws where one is nearly one of
  /// `read`: its reader would pass over it and take a default.
  std::vector<std::string> unknownKeys(const std::vector<std::string>& read,
                                       const std::vector<std::string>& harmless) const;
  /// Throws where a name is none of `known`, or where a note "key:=value" stands for one.
  void requireKnownKeys(const std::vector<std::string>& known) const;

  /// InputError: the file, the key, what it holds, and what is wrong with it.
  [[noreturn]] void fail(const std::string& key, const std::string& complaint) const;

 private:
  void add(const std::string& key, const std::string& value);

  std::string path_;
  std::uintmax_t end_offset_ = 0;
  std::map<std::string, std::string> fields_;
  std::set<std::string> notes_;
};

/// The finite numbers of "1 0 0"; commas count as spaces. Empty where a word is none.
std::vector<double> finiteNumbers(std::string text);

/// What a header holds, for a message: in quotes, at most 60 characters, unprintable ones as `?`.
std::string inQuotes(const std::string& text);

}  // namespace softscope
