// src/calibrate/board.h: calibration boards and their corners in an image.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.h"

namespace softscope {

/// A flat board of squares. Without markers: a checkerboard, `columns` x `rows` inner corners. With
/// markers: OpenCV's ChArUco board, `columns` x `rows` squares.
struct BoardOptions {
  int columns = 9;
  int rows = 6;
  double square_mm = 0;               // side of a square
  double marker_mm = 0;               // side of a marker; 0 = a checkerboard
  std::string dictionary = "4X4_50";  // of the markers, by OpenCV's name without DICT_

  bool hasMarkers() const { return marker_mm > 0; }
  int cornerColumns() const { return hasMarkers() ? columns - 1 : columns; }
  int cornerRows() const { return hasMarkers() ? rows - 1 : rows; }
  int cornerCount() const { return cornerColumns() * cornerRows(); }
  /// In the board's frame (z = 0), mm; id counts along the rows.
  Eigen::Vector3d cornerPosition(int id) const;

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

struct BoardCorner {
  int id = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// Sub-pixel corners of the board; none where it is not in the image. Of a checkerboard all corners
/// or none, of a ChArUco board those whose markers are seen (6 or more).
std::vector<BoardCorner> findBoard(const GrayImage& image, const BoardOptions& board);

/// Turns the corners of a checkerboard in the right view by half a turn where that brings them into
/// the order of the left view: the ends of a board are not marked.
void matchOrder(const std::vector<BoardCorner>& left, const BoardOptions& board,
                std::vector<BoardCorner>* right);

/// Width of the board's edges in the image, px: contrast over steepest slope. The larger of the
/// medians across its rows and its columns, so that a motion blur in either direction counts. NaN
/// where no two neighbouring corners are known.
double edgeWidthPx(const GrayImage& image, const std::vector<BoardCorner>& corners,
                   const BoardOptions& board);

}  // namespace softscope
