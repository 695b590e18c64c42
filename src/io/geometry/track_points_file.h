// src/io/geometry/track_points_file.h: pixels of the first left image to be tracked.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// A pixel of the first left image as it is on disk, with a number of its own.
struct TrackPixel {
  int id = 0;
  double u_px = 0, v_px = 0;
};

/// CSV with the heading id,u_px,v_px. Throws InputError with the line: no heading, not three
/// numbers, an id that is no whole number or stands twice, a pixel that isn't finite.
std::vector<TrackPixel> readTrackPixels(const std::filesystem::path& file);
std::vector<TrackPixel> parseTrackPixels(std::string_view text, const std::string& name);

}  // namespace softscope
