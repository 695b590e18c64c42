// vtk_views/text_header.cpp: a few lines of text before the voxels.
#include "vtk_views/text_header.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <sstream>
#include <vector>

#include "core/error.h"

namespace softscope {
namespace {

using Fields = std::map<std::string, std::string>;
constexpr int kLongestHeader = 1000;  // lines; voxels that look like text end here

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Lines "key<separator>value" up to an empty line, or to the key that starts the voxels.
Fields readFields(const std::string& path, char separator, const std::string& last_key) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": can't be opened. Does it exist, and may you read it?");
  Fields fields;
  std::string line;
  for (int n = 0; n < kLongestHeader && std::getline(file, line); ++n) {
    line = trimmed(line);
    if (line.empty()) break;
    const auto at = line.find(separator);
    if (line[0] == '#' || at == std::string::npos) continue;
    const std::string key = trimmed(line.substr(0, at));
    const auto value_at = line.find_first_not_of(separator == ':' ? ":=" : "=", at);
    fields[key] = value_at == std::string::npos ? "" : trimmed(line.substr(value_at));
    if (key == last_key) break;
  }
  return fields;
}

void requireField(const std::string& path, const Fields& fields, const std::string& key) {
  if (fields.count(key) == 0)
    throw InputError(path + ": the header has no line `" + key +
                     "`. Is the file complete, and of the kind its name says?");
}

/// The numbers of "(1,0,0) (0,1,0)" or "1 0 0"; "none" entries (other axes than space) are skipped.
std::vector<double> numbers(const std::string& path, const std::string& key, std::string text) {
  for (char& c : text)
    if (c == '(' || c == ')' || c == ',') c = ' ';
  std::istringstream words(text);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    if (word == "none") continue;
    try {
      values.push_back(std::stod(word));
    } catch (const std::exception&) {
      throw InputError(path + ": " + key + " has \"" + word + "\" where a number belongs");
    }
  }
  return values;
}

std::vector<double> numbersOr(const std::string& path, const Fields& fields, const std::string& key,
                              std::vector<double> otherwise) {
  const auto found = fields.find(key);
  if (found == fields.end()) return otherwise;
  const auto values = numbers(path, key, found->second);
  if (values.size() < otherwise.size())
    throw InputError(path + ": " + key + " has " + std::to_string(values.size()) +
                     " numbers, but a volume needs " + std::to_string(otherwise.size()));
  return values;
}

/// "left-posterior-superior" becomes "LPS"; a short form stays.
std::string shortSpace(std::string name) {
  for (char& c : name) c = char(std::tolower(static_cast<unsigned char>(c)));
  std::string letters(1,
                      char(std::toupper(static_cast<unsigned char>(name.empty() ? '?' : name[0]))));
  for (std::size_t i = 0; i + 1 < name.size(); ++i)
    if (name[i] == '-') letters += char(std::toupper(static_cast<unsigned char>(name[i + 1])));
  if (letters.size() == 3) return letters;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  return name.size() == 3 ? name : "unknown";
}

int bytesOf(const std::string& element_type) {
  for (const auto& [name, bytes] :
       std::initializer_list<std::pair<const char*, int>>{{"CHAR", 1},
                                                          {"SHORT", 2},
                                                          {"INT", 4},
                                                          {"LONG_LONG", 8},
                                                          {"LONG", 4},
                                                          {"FLOAT", 4},
                                                          {"DOUBLE", 8}}) {
    const auto at = element_type.find(name);
    if (at != std::string::npos) return bytes;
  }
  return 0;
}

/// What the voxels of a binary MetaImage take; 0 where the header doesn't say it.
double voxelBytes(const std::string& path, const Fields& fields) {
  const auto has = [&](const char* key, const char* value) {
    const auto found = fields.find(key);
    return found != fields.end() && found->second == value;
  };
  if (has("CompressedData", "True")) return numbersOr(path, fields, "CompressedDataSize", {0})[0];
  if (!has("BinaryData", "True")) return 0;
  double bytes = bytesOf(fields.at("ElementType"));
  for (const double size : numbersOr(path, fields, "DimSize", {0, 0, 0})) bytes *= size;
  return bytes * numbersOr(path, fields, "ElementNumberOfChannels", {1})[0];
}

/// VTK's reader would say so on stdout and hand out what it has.
void requireAllVoxels(const std::string& path, const Fields& fields) {
  namespace fs = std::filesystem;
  const std::string& data = fields.at("ElementDataFile");
  const bool local = data == "LOCAL";
  const fs::path file = local ? fs::path(path) : fs::path(path).parent_path() / data;
  std::error_code problem;
  const auto there = static_cast<double>(fs::file_size(file, problem));
  if (problem) return;  // a list or a pattern of files: VTK's to judge
  if (there < voxelBytes(path, fields))
    throw InputError(file.string() +
                     ": is cut short: its voxels end before its header says. Copy it again");
}

const std::vector<double> kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1};

}  // namespace

HeaderGeometry readNrrdGeometry(const std::string& path) {
  const Fields fields = readFields(path, ':', "");
  for (const char* key : {"type", "dimension", "sizes", "encoding"})
    requireField(path, fields, key);
  HeaderGeometry geometry;
  const auto directions = numbersOr(path, fields, "space directions", kIdentity);
  const auto origin = numbersOr(path, fields, "space origin", {0, 0, 0});
  const auto spacings = numbersOr(path, fields, "spacings", {1, 1, 1});
  const bool oriented = fields.count("space directions") > 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int row = 0; row < 3; ++row)
      geometry.space_from_voxel(row, axis) =
          directions[std::size_t(3 * axis + row)] * (oriented ? 1 : spacings[std::size_t(axis)]);
  for (int row = 0; row < 3; ++row) geometry.space_from_voxel(row, 3) = origin[std::size_t(row)];
  if (const auto space = fields.find("space"); space != fields.end())
    geometry.space = shortSpace(space->second);
  return geometry;
}

HeaderGeometry readMetaImageGeometry(const std::string& path) {
  const Fields fields = readFields(path, '=', "ElementDataFile");
  for (const char* key : {"NDims", "DimSize", "ElementType", "ElementDataFile"})
    requireField(path, fields, key);
  requireAllVoxels(path, fields);
  HeaderGeometry geometry;
  const char* origin_key = fields.count("Offset")     ? "Offset"
                           : fields.count("Position") ? "Position"
                                                      : "Origin";
  const char* spacing_key = fields.count("ElementSpacing") ? "ElementSpacing" : "ElementSize";
  const auto directions = numbersOr(path, fields, "TransformMatrix", kIdentity);
  const auto origin = numbersOr(path, fields, origin_key, {0, 0, 0});
  const auto spacing = numbersOr(path, fields, spacing_key, {1, 1, 1});
  for (int axis = 0; axis < 3; ++axis)
    for (int row = 0; row < 3; ++row)
      geometry.space_from_voxel(row, axis) =
          directions[std::size_t(3 * axis + row)] * spacing[std::size_t(axis)];
  for (int row = 0; row < 3; ++row) geometry.space_from_voxel(row, 3) = origin[std::size_t(row)];
  geometry.space = "LPS";
  return geometry;
}

}  // namespace softscope
