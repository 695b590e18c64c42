// toolkit/run/table_reader.h: reader of the tables of a run and of its truth.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "eval/motion/track_errors.h"
#include "pipeline/frame_record.h"

namespace softscope {

/// Numeric columns of a CSV file by their heading. Other columns are not checked.
class NumberTable {
 public:
  /// `needed` columns must exist, `optional` ones may be missing. Empty cells
  /// are NaN. Throws InputError with the line: a missing column, a row of
  /// another length, an invalid number. `word`: an optional column of texts.
  NumberTable(std::string_view text, const std::string& name,
              const std::vector<std::string>& needed, const std::vector<std::string>& optional,
              const std::string& word = {});

  std::size_t rows() const { return rows_.size(); }
  bool has(std::size_t column) const { return places_[column] >= 0; }
  /// `column`: index into needed, then optional.
  double at(std::size_t row, std::size_t column) const { return rows_[row][column]; }
  /// Cell of the column of texts; empty if missing.
  const std::string& wordAt(std::size_t row) const { return words_[row]; }
  int lineOf(std::size_t row) const { return lines_[row]; }
  /// Checked as a non-negative integer; else InputError.
  int indexAt(std::size_t row, std::size_t column) const;
  /// Three columns from `column` on, in mm; NaN for an empty cell. InputError beyond 1 km.
  Eigen::Vector3d placeAt(std::size_t row, std::size_t column) const;

 private:
  void readHeading(std::string_view line, const std::vector<std::string>& needed,
                   const std::vector<std::string>& optional, const std::string& word);
  void readRow(std::string_view line, int line_number);

  std::string name_;
  std::vector<int> places_;  // index of each column in the file; -1 = missing
  int word_place_ = -1;
  std::size_t cells_ = 0;  // per row
  std::vector<std::vector<double>> rows_;
  std::vector<std::string> words_;
  std::vector<int> lines_;
};

/// frame,id,x_mm,y_mm,z_mm[,visible]; lost positions are NaN.
std::vector<TrackSample> readTracks(const std::filesystem::path& file);

/// From frames.csv: ascending `frame`; backprojection_mean_mm, coverage,
/// confidence, NaN if missing; map, 0 if missing; status, empty without that column.
struct FrameRows {
  std::vector<int> frames, maps;
  std::vector<double> backprojection_mm, coverage, confidence;
  std::vector<FrameStatus> statuses;
};

FrameRows readFrameRows(const std::filesystem::path& file);

}  // namespace softscope
