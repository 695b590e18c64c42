// toolkit/calibration/board_film.h: detection of a board in two videos, or in one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/view_choice.h"
#include "toolkit/progress.h"

namespace softscope {

struct BoardFilmOptions {
  std::filesystem::path left, right;  // folders of images or videos; empty right: both views in one
  std::string layout = "auto";        // packing of both views: io/sequences/stereo_packing.h
  bool right_first = false;
  int every = 0;  // every n-th frame; 0: at most 300 frames
  BoardOptions board;

  /// Throws OptionError.
  void validate() const;
};

struct BoardFilm {
  int width_px = 0, height_px = 0;
  int frames = 0;  // searched frames
  int in_left = 0, in_right = 0;
  std::vector<BoardSighting> sightings;  // boards found in both views
  std::vector<std::string> unreadable;   // one reason per unreadable frame
  bool stopped = false;                  // stopped by `progress`
};

/// Throws InputError for a missing or damaged video,
/// different sizes, or no frame with the board in both views.
BoardFilm readBoardFilm(const BoardFilmOptions& options, const Progress& progress = {});

}  // namespace softscope
