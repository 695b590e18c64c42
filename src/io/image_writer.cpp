#include "io/image_writer.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/image_codec.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

cv::Mat bgrOf(const ColourImage& image) {
  cv::Mat bgr;
  cv::cvtColor(matrixView(image, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

/// Asks before the work of encoding is done.
void write(const fs::path& file, const char* extension, const cv::Mat& image, bool overwrite,
           const std::vector<int>& parameters = {}) {
  requireWritable(file, overwrite);
  writeFile(file, encodeImage(extension, image, parameters), overwrite);
}

}  // namespace

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
