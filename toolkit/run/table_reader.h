// toolkit/run/table_reader.h: the tables of a run and of its truth.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "eval/motion/track_errors.h"
#include "pipeline/frame_record.h"

namespace softscope {

/// Columns of numbers by their heading, from a CSV file. Cells of other columns may hold anything.
class NumberTable {
 public:
  /// `needed`: columns that must be there, `optional` ones may lack. Empty cells are NaN. Throws
  /// InputError with the line: a missing column, a row of another length, a cell that is no number.
  /// `word`: a column whose cells are words, which may lack as well.
  NumberTable(std::string_view text, const std::string& name,
              const std::vector<std::string>& needed, const std::vector<std::string>& optional,
              const std::string& word = {});

  std::size_t rows() const { return rows_.size(); }
  bool has(std::size_t column) const { return places_[column] >= 0; }
  /// `column`: into needed, then optional.
  double at(std::size_t row, std::size_t column) const { return rows_[row][column]; }
  /// Of the column of words; empty where it lacks.
  const std::string& wordAt(std::size_t row) const { return words_[row]; }
  int lineOf(std::size_t row) const { return lines_[row]; }
  /// The same, which must be a whole number from 0 on; else InputError.
  int indexAt(std::size_t row, std::size_t column) const;
  /// Three columns from `column` on, in mm; NaN where a cell is. InputError beyond 1 km.
  Eigen::Vector3d placeAt(std::size_t row, std::size_t column) const;

 private:
  void readHeading(std::string_view line, const std::vector<std::string>& needed,
                   const std::vector<std::string>& optional, const std::string& word);
  void readRow(std::string_view line, int line_number);

  std::string name_;
  std::vector<int> places_;  // of each column in the file; -1 = not there
  int word_place_ = -1;
  std::size_t cells_ = 0;  // of every line
  std::vector<std::vector<double>> rows_;
  std::vector<std::string> words_;
  std::vector<int> lines_;
};

/// frame,id,x_mm,y_mm,z_mm[,visible]; positions that were lost are NaN.
std::vector<TrackSample> readTracks(const std::filesystem::path& file);

/// Of frames.csv: `frame`, rising; backprojection_mean_mm, coverage, confidence, NaN where they
/// lack; status, empty without that column.
struct FrameRows {
  std::vector<int> frames;
  std::vector<double> backprojection_mm, coverage, confidence;
  std::vector<FrameStatus> statuses;
};

FrameRows readFrameRows(const std::filesystem::path& file);

}  // namespace softscope
