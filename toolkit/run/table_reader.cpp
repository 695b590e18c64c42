// toolkit/run/table_reader.cpp: CSV as in RFC 4180, one line per row.
#include "toolkit/run/table_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/farthest.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

/// Commas inside quotes do not separate cells.
std::vector<std::string_view> commaCells(std::string_view line) {
  std::vector<std::string_view> cells;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != ',')) continue;
    cells.push_back(trimmed(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  return cells;
}

FrameStatus statusAt(const NumberTable& table, std::size_t row, const std::string& name) {
  if (const auto status = frameStatusNamed(table.wordAt(row))) return *status;
  throw InputError(say(name, ": line ", table.lineOf(row), " has the status ",
                       excerpt(table.wordAt(row)),
                       ", which is unknown; is the file damaged? Reconstruct again"));
}

}  // namespace

NumberTable::NumberTable(std::string_view text, const std::string& name,
                         const std::vector<std::string>& needed,
                         const std::vector<std::string>& optional, const std::string& word)
    : name_(name) {
  int line_number = 0;
  for (const std::string_view line : linesOf(text)) {
    ++line_number;
    if (trimmed(line).empty()) continue;
    if (cells_ == 0)
      readHeading(line, needed, optional, word);
    else
      readRow(line, line_number);
  }
  if (cells_ == 0) throw InputError(name + ": is empty, but a heading is expected");
}

void NumberTable::readHeading(std::string_view line, const std::vector<std::string>& needed,
                              const std::vector<std::string>& optional, const std::string& word) {
  const auto cells = commaCells(line);
  cells_ = cells.size();
  const auto placeOf = [&](const std::string& column) {
    const auto found = std::find(cells.begin(), cells.end(), column);
    return found == cells.end() ? -1 : static_cast<int>(found - cells.begin());
  };
  for (const std::string& column : needed) {
    places_.push_back(placeOf(column));
    if (places_.back() < 0)
      throw InputError(say(name_, ": has no column `", column, "`; its headings are ",
                           excerpt(line), ". Is it the right file?"));
  }
  for (const std::string& column : optional) places_.push_back(placeOf(column));
  if (!word.empty()) word_place_ = placeOf(word);
}

void NumberTable::readRow(std::string_view line, int line_number) {
  const auto cells = commaCells(line);
  if (cells.size() != cells_)
    throw InputError(say(name_, ": line ", line_number, " has ", cells.size(), " cells, but ",
                         cells_, " are expected; is the file truncated?"));
  std::vector<double> values;
  for (const int place : places_) {
    const std::string_view cell = place < 0 ? "" : cells[static_cast<std::size_t>(place)];
    const auto value = numberOf(cell);
    if (!value && !cell.empty())
      throw InputError(say(name_, ": line ", line_number, " holds ", excerpt(cell),
                           ", but a number is expected"));
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  rows_.push_back(std::move(values));
  words_.emplace_back(word_place_ < 0 ? "" : cells[static_cast<std::size_t>(word_place_)]);
  lines_.push_back(line_number);
}

int NumberTable::indexAt(std::size_t row, std::size_t column) const {
  const double value = at(row, column);
  if (value >= 0 && value <= 1e9 && value == std::floor(value)) return static_cast<int>(value);
  throw InputError(say(name_, ": line ", lines_[row], " holds ", value,
                       ", but a whole number from 0 on is expected"));
}

Eigen::Vector3d NumberTable::placeAt(std::size_t row, std::size_t column) const {
  const Eigen::Vector3d place_mm(at(row, column), at(row, column + 1), at(row, column + 2));
  for (const double value : place_mm)
    if (std::abs(value) > kFarthestMm)
      throw InputError(say(name_, ": line ", lines_[row], " holds ", value,
                           " mm, but a coordinate within 1 km is expected; is the file damaged?"));
  return place_mm;
}

std::vector<TrackSample> readTracks(const std::filesystem::path& file) {
  const NumberTable table(readText(file), shown(file), {"frame", "id", "x_mm", "y_mm", "z_mm"},
                          {"visible", "sigma_mm"});
  std::vector<TrackSample> tracks;
  tracks.reserve(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i)
    tracks.push_back({table.indexAt(i, 0), table.indexAt(i, 1), table.placeAt(i, 2),
                      !table.has(5) || table.at(i, 5) != 0,
                      table.has(6) ? table.at(i, 6) : Statistics::kNone});
  return tracks;
}

FrameRows readFrameRows(const std::filesystem::path& file) {
  const NumberTable table(readBytes(file), shown(file), {"frame"},
                          {"backprojection_mean_mm", "coverage", "confidence", "map"}, "status");
  FrameRows rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    rows.frames.push_back(table.indexAt(i, 0));
    rows.backprojection_mm.push_back(table.at(i, 1));
    rows.coverage.push_back(table.at(i, 2));
    rows.confidence.push_back(table.at(i, 3));
    rows.maps.push_back(table.has(4) ? table.indexAt(i, 4) : 0);
    if (i > 0 && rows.frames[i] <= rows.frames[i - 1])
      throw InputError(say(shown(file), ": frame ", rows.frames[i], " stands below frame ",
                           rows.frames[i - 1], "; they must ascend"));
  }
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (!table.wordAt(i).empty()) rows.statuses.push_back(statusAt(table, i, shown(file)));
  if (!rows.statuses.empty() && rows.statuses.size() != rows.frames.size())
    throw InputError(shown(file) +
                     ": some frames have no status, but all or none are expected; is the file "
                     "damaged? Reconstruct again");
  return rows;
}

}  // namespace softscope
