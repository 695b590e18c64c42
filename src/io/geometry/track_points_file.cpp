#include "io/geometry/track_points_file.h"

#include <cmath>
#include <set>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

constexpr std::size_t kNamedIds = 5;  // in a message
constexpr const char* kHeading = "id,u_px,v_px";
constexpr const char* kAdvice =
    "; expected is the heading id,u_px,v_px and then a line a point, such as 7,312.5,240";

[[noreturn]] void fail(const std::string& name, std::size_t line, std::string_view found,
                       const char* advice) {
  throw InputError(say(name, ", line ", line, ": found ", excerpt(found), advice));
}

TrackPixel pixelOf(std::string_view line, const std::string& name, std::size_t number) {
  const std::vector<std::string_view> words = wordsOf(line);
  if (words.size() != 3) fail(name, number, line, kAdvice);
  double values[3];
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value = numberOf(words[static_cast<std::size_t>(i)]);
    if (!value || !std::isfinite(*value)) fail(name, number, line, kAdvice);
    values[i] = *value;
  }
  if (std::abs(values[0]) > 1e9 || values[0] != std::floor(values[0]))
    fail(name, number, line, "; an id is a whole number");
  return {static_cast<int>(values[0]), values[1], values[2]};
}

}  // namespace

std::vector<TrackPixel> parseTrackPixels(std::string_view text, const std::string& name) {
  std::vector<TrackPixel> pixels;
  std::set<int> known;
  bool headed = false;
  std::size_t number = 0;
  for (const std::string_view raw : linesOf(text)) {
    ++number;
    const std::string_view line = trimmed(raw);
    if (line.empty() || line.front() == '#') continue;
    if (!headed) {
      if (line != kHeading) fail(name, number, line, kAdvice);
      headed = true;
      continue;
    }
    const TrackPixel pixel = pixelOf(line, name, number);
    if (!known.insert(pixel.id).second)
      fail(name, number, line, "; its id is a duplicate. Number points uniquely");
    pixels.push_back(pixel);
  }
  if (pixels.empty()) throw InputError(say(name, ": holds no point", kAdvice));
  return pixels;
}

std::string outsideWarning(const std::vector<TrackPixel>& pixels, int width_px, int height_px,
                           const std::string& name) {
  std::size_t outside = 0;
  std::string ids;
  for (const TrackPixel& pixel : pixels) {
    const bool inside = pixel.u_px >= -0.5 && pixel.u_px < width_px - 0.5 && pixel.v_px >= -0.5 &&
                        pixel.v_px < height_px - 0.5;  // (0, 0) is a pixel's centre
    if (inside) continue;
    if (++outside <= kNamedIds) ids += (outside == 1 ? "" : ", ") + std::to_string(pixel.id);
  }
  if (outside == 0) return {};
  const std::string found =
      say(name, ": ", outside, " of ", pixels.size(), " pixels are outside the left image of ",
          width_px, " x ", height_px, " px (id ", ids, outside > kNamedIds ? ", …" : "",
          "); u_px, v_px are pixels of the first left image, from 0, 0 in the top left");
  if (outside == pixels.size()) throw InputError(found);
  return found + ". They get no position";
}

std::vector<TrackPixel> readTrackPixels(const std::filesystem::path& file) {
  return parseTrackPixels(readText(file, kTextLimitBytes), shown(file));
}

}  // namespace softscope
