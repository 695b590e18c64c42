// toolkit/comparison/landmark_places.cpp: reader of two kinds of tables.
#include "toolkit/comparison/landmark_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/farthest.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

using Cells = std::vector<std::string_view>;

Cells cellsOf(std::string_view line) {
  Cells cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

/// Column indices of name, x, y and z; -1: missing.
using Columns = std::array<std::ptrdiff_t, 4>;

Columns columnsOf(const Cells& heading) {
  constexpr const char* kNames[4][3] = {{"name", "label", "id"},
                                        {"x_mm", "reference_x_mm", "x"},
                                        {"y_mm", "reference_y_mm", "y"},
                                        {"z_mm", "reference_z_mm", "z"}};
  Columns columns{-1, -1, -1, -1};
  for (std::size_t i = 0; i < 4; ++i)
    for (const char* name : kNames[i]) {
      const auto found = std::find(heading.begin(), heading.end(), name);
      if (columns[i] < 0 && found != heading.end()) columns[i] = found - heading.begin();
    }
  return columns;
}

bool complete(const Columns& columns) {
  return *std::min_element(columns.begin(), columns.end()) >= 0;
}

/// Space in the header of a Slicer file: words in later versions, numbers in earlier ones (0: RAS).
bool isRas(std::string_view line) {
  const std::string_view value = trimmed(line.substr(line.find('=') + 1));
  return value == "RAS" || value == "0";
}

/// Reader of one file; every error message begins with `where_`.
class PlacesReader {
 public:
  explicit PlacesReader(std::string where) : where_(std::move(where)) {}
  LandmarkPlaces read(std::string_view text);

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(where_ + ": " + what); }
  void readComment(std::string_view line);
  void addRow(const Cells& cells, int line);

  std::string where_;
  Columns columns_{-1, -1, -1, -1};
  bool ras_ = false;
  LandmarkPlaces places_;
};

void PlacesReader::readComment(std::string_view line) {
  if (line.find("CoordinateSystem") != line.npos) ras_ = isRas(line);
  const auto at = line.find("columns =");
  if (at != line.npos) columns_ = columnsOf(cellsOf(line.substr(at + 9)));
}

void PlacesReader::addRow(const Cells& cells, int line) {
  const auto cell = [&](std::size_t which) {
    const auto column = static_cast<std::size_t>(columns_[which]);
    return column < cells.size() ? cells[column] : std::string_view();
  };
  Eigen::Vector3d place_mm;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = numberOf(cell(static_cast<std::size_t>(axis) + 1));
    if (!value || !(std::abs(*value) <= kFarthestMm))
      fail(say("line ", line, ": ", excerpt(cell(static_cast<std::size_t>(axis) + 1)),
               " is no coordinate in mm within 1 km"));
    place_mm[axis] = *value;
  }
  if (ras_) place_mm.head<2>() = -place_mm.head<2>();
  if (cell(0).empty()) fail(say("line ", line, ": the landmark has no name"));
  if (!places_.emplace(std::string(cell(0)), place_mm).second)
    fail(say("line ", line, ": ", excerpt(cell(0)), " is a duplicate"));
}

LandmarkPlaces PlacesReader::read(std::string_view text) {
  int number = 0;
  for (const std::string_view line : linesOf(text)) {
    ++number;
    if (trimmed(line).empty()) continue;
    if (line.front() == '#') {
      readComment(line);
    } else if (!complete(columns_)) {
      columns_ = columnsOf(cellsOf(line));
      if (!complete(columns_)) fail("needs a heading with name, x_mm, y_mm and z_mm");
    } else {
      addRow(cellsOf(line), number);
    }
  }
  if (places_.empty()) fail("has no landmarks");
  return places_;
}

}  // namespace

LandmarkPlaces readLandmarkPlaces(const std::filesystem::path& file) {
  constexpr std::uintmax_t kLimitBytes = 1 << 24;
  return PlacesReader(shown(file)).read(readText(file, kLimitBytes));
}

}  // namespace softscope
