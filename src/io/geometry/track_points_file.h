// src/io/geometry/track_points_file.h: reader of the pixels to be tracked.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Pixel of the first left image on disk, with its id.
struct TrackPixel {
  int id = 0;
  double u_px = 0, v_px = 0;
};

/// CSV with the heading id,u_px,v_px. Throws InputError with the line: no heading,
/// not three numbers, an invalid or duplicate id, a pixel that is not finite.
std::vector<TrackPixel> readTrackPixels(const std::filesystem::path& file);
std::vector<TrackPixel> parseTrackPixels(std::string_view text, const std::string& name);

/// Warning that counts and names the pixels outside an image of this size; empty without any.
/// Throws InputError if all are outside.
std::string outsideWarning(const std::vector<TrackPixel>& pixels, int width_px, int height_px,
                           const std::string& name);

}  // namespace softscope
