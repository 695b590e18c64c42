// toolkit/calibration/board_film.h: the boards in two films, or in one with both views.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/view_choice.h"
#include "toolkit/progress.h"

namespace softscope {

struct BoardFilmOptions {
  std::filesystem::path left, right;  // folders of images or videos; no right: both views in one
  std::string layout = "auto";        // of both views in one image: io/sequences/stereo_packing.h
  bool right_first = false;
  int every = 0;  // each n-th frame; 0: as many as give 300 frames at most
  BoardOptions board;

  /// Throws OptionError.
  void validate() const;
};

struct BoardFilm {
  int width_px = 0, height_px = 0;
  int frames = 0;  // that were looked at
  int in_left = 0, in_right = 0;
  std::vector<BoardSighting> sightings;  // boards in both views
  std::vector<std::string> unreadable;   // why, a line a frame
  bool stopped = false;                  // by `progress`
};

/// Throws InputError where a film is missing or broken, sizes differ, or no frame shows the board
/// in both views.
BoardFilm readBoardFilm(const BoardFilmOptions& options, const Progress& progress = {});

}  // namespace softscope
