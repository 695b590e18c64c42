#include "io/images/image_writer.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/images/image_codec.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

cv::Mat bgrOf(const ColourImage& image) {
  cv::Mat bgr;
  cv::cvtColor(matrixView(image, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

/// Checks the target before the encoding.
void write(const fs::path& file, const char* extension, const cv::Mat& image, bool overwrite,
           const std::vector<int>& parameters = {}) {
  requireWritable(file, overwrite);
  writeFile(file, encodeImage(extension, image, parameters), overwrite);
}

void appendBigEndian(std::uint32_t value, std::string& bytes) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char(value >> shift & 255);
}

/// Cyclic redundancy check of the PNG specification, annex D.
std::uint32_t checkSum(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

/// Chunk of physical dimensions; it precedes the pixels.
std::string dimensionsChunk(double dots_per_inch) {
  const auto dots_per_metre = static_cast<std::uint32_t>(std::lround(dots_per_inch / 0.0254));
  std::string content = "pHYs";
  appendBigEndian(dots_per_metre, content);
  appendBigEndian(dots_per_metre, content);
  content += '\1';  // unit: metre
  std::string chunk;
  appendBigEndian(static_cast<std::uint32_t>(content.size() - 4), chunk);
  chunk += content;
  appendBigEndian(checkSum(content), chunk);
  return chunk;
}

}  // namespace

void writePng(const fs::path& file, const ColourImage& image, double dots_per_inch,
              bool overwrite) {
  require(dots_per_inch >= 1 && dots_per_inch <= 1e5, "dots per inch", dots_per_inch,
          "must be 1 to 100000");
  requireWritable(file, overwrite);
  std::string bytes = encodeImage(".png", bgrOf(image), {});
  constexpr std::size_t kBehindHeader = 33;  // eight bytes of signature, and the IHDR chunk
  bytes.insert(kBehindHeader, dimensionsChunk(dots_per_inch));
  writeFile(file, bytes, overwrite);
}

void writePng(const fs::path& file, const GrayImage& image, bool overwrite) {
  write(file, ".png", matrixView(image, CV_8U), overwrite);
}
void writePng(const fs::path& file, const ColourImage& image, bool overwrite) {
  write(file, ".png", bgrOf(image), overwrite);
}
void writePng(const fs::path& file, const Raster<std::uint16_t>& image, bool overwrite) {
  write(file, ".png", matrixView(image, CV_16U), overwrite);
}

void writeJpeg(const fs::path& file, const ColourImage& image, int quality, bool overwrite) {
  require(quality >= 1 && quality <= 100, "quality", quality, "must be 1 to 100");
  write(file, ".jpg", bgrOf(image), overwrite, {cv::IMWRITE_JPEG_QUALITY, quality});
}

}  // namespace softscope
