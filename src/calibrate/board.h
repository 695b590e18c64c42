// src/calibrate/board.h: calibration boards and detection of their corners.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Flat board of squares. Without markers: a checkerboard with `columns` x `rows` inner
/// corners. With markers: ChArUco board of OpenCV with `columns` x `rows` squares.
struct BoardOptions {
  int columns = 9;
  int rows = 6;
  double square_mm = 0;               // side of a square
  double marker_mm = 0;               // side of a marker; 0 = a checkerboard
  std::string dictionary = "4X4_50";  // of the markers, name in OpenCV without DICT_

  bool hasMarkers() const { return marker_mm > 0; }
  int cornerColumns() const { return hasMarkers() ? columns - 1 : columns; }
  int cornerRows() const { return hasMarkers() ? rows - 1 : rows; }
  int cornerCount() const { return cornerColumns() * cornerRows(); }
  /// In the frame of the board (z = 0), mm; id counts along the rows.
  Eigen::Vector3d cornerPosition(int id) const;

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

struct BoardCorner {
  int id = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// Sub-pixel corners of the board; empty if not found. For a checkerboard all
/// corners or none, for a ChArUco board those with visible markers (6 or more).
std::vector<BoardCorner> findBoard(const GrayImage& image, const BoardOptions& board);

/// Reverses the corners of a checkerboard in the right view if that
/// gives the order of the left view: the ends of a board are not marked.
void matchOrder(const std::vector<BoardCorner>& left, const BoardOptions& board,
                std::vector<BoardCorner>* right);

/// Width of the edges of the board in the image, px: contrast over steepest
/// slope. The larger of the medians across rows and columns, so that motion
/// blur in either direction counts. NaN without two known neighbouring corners.
double edgeWidthPx(const GrayImage& image, const std::vector<BoardCorner>& corners,
                   const BoardOptions& board);

}  // namespace softscope
