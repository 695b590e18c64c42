// toolkit/inspection/describe_image.cpp: facts about an image, a depth file or a video.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/median.h"
#include "io/files/file_bytes.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_header.h"
#include "io/images/image_reader.h"
#include "io/sequences/picture_source.h"
#include "toolkit/inspection/describe_file.h"

namespace softscope {
namespace {

const char* nameOf(ImageForm form) {
  switch (form) {
    case ImageForm::kPng:
      return "PNG";
    case ImageForm::kJpeg:
      return "JPEG";
    case ImageForm::kBmp:
      return "BMP";
    case ImageForm::kTiff:
      return "TIFF";
    case ImageForm::kPnm:
      return "PNM";
  }
  return "unknown";
}

void addSize(int width_px, int height_px, FactSheet& facts) {
  facts.add("size", std::to_string(width_px) + " x " + std::to_string(height_px) + " px",
            "width_px", width_px);
  facts.addQuietly("height_px", height_px);
}

void addBrightness(const ColourImage& image, FactSheet& facts) {
  const GrayImage gray = toGray(image);
  double sum = 0;
  std::size_t dark = 0, bright = 0;
  for (const std::uint8_t value : gray.values) {
    sum += value;
    dark += value < 10;
    bright += value >= 250;
  }
  const auto count = double(gray.size());
  const bool colour = std::any_of(image.values.begin(), image.values.end(), [](const Rgb8& c) {
    return c.red != c.green || c.green != c.blue;
  });
  facts.add("colour", colour ? "yes" : "no, grey", "colour", colour);
  facts.add("brightness",
            "mean " + fixed(sum / count, 1) + ", " + fixed(100 * double(dark) / count, 1) +
                " % dark (below 10), " + fixed(100 * double(bright) / count, 1) +
                " % saturated (250 and above)",
            "mean_gray", sum / count);
  facts.addQuietly("dark_share", double(dark) / count);
  facts.addQuietly("saturated_share", double(bright) / count);
  if (double(dark) > 0.5 * count) facts.warn("more than half of the image is dark");
}

}  // namespace

FactSheet describeImage(const std::string& file) {
  const std::string bytes = readBytes(file);
  const ImageHeader header = inspectImage(bytes, file);
  FactSheet facts(file + ": an image");
  facts.addQuietly("kind", "image");
  facts.add("format", "format", nameOf(header.form));
  addSize(header.width_px, header.height_px, facts);
  addBrightness(parseColourImage(bytes, file), facts);
  return facts;
}

FactSheet describeFloatMap(const std::string& file) {
  const Raster<float> raster = readDisparity(file);
  FactSheet facts(file + ": a float map (depth in mm or disparity in px)");
  facts.addQuietly("kind", "float map");
  addSize(raster.width_px, raster.height_px, facts);
  std::vector<float> values;
  std::copy_if(raster.values.begin(), raster.values.end(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  const double coverage = double(values.size()) / double(raster.size());
  facts.add("measured", fixed(100 * coverage, 1) + " % of the pixels", "coverage", coverage);
  if (values.empty()) {
    facts.warn("no pixel has a value");
    return facts;
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double lowest = *least, highest = *most;
  const float median = medianOf(std::move(values));
  facts.add("values",
            fixed(lowest, 2) + " to " + fixed(highest, 2) + ", median " + fixed(median, 2),
            "value_range", {lowest, highest});
  facts.addQuietly("median", median);
  return facts;
}

FactSheet describeVideo(const std::string& file) {
  const auto video = openPictures(file);
  const ColourImage first = video->read(0);
  FactSheet facts(file + ": a video");
  facts.addQuietly("kind", "video");
  facts.add("frames", "frames", video->count());
  addSize(first.width_px, first.height_px, facts);
  if (video->framesPerSecond() > 0)
    facts.add("rate", fixed(video->framesPerSecond(), 2) + " frames a second", "frames_per_second",
              video->framesPerSecond());
  addBrightness(first, facts);
  return facts;
}

}  // namespace softscope
