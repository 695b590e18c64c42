#include "io/images/image_reader.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/images/image_codec.h"
#include "io/images/image_header.h"
#include "io/text/message.h"

namespace softscope {
namespace {

constexpr int kJpegMaskThreshold = 128;

/// Maximum over the channels, as CV_16U or CV_8U.
cv::Mat largestChannel(const cv::Mat& image) {
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  cv::Mat out = channels[0];
  for (std::size_t i = 1; i < channels.size(); ++i) cv::max(out, channels[i], out);
  return out;
}

}  // namespace

ColourImage parseColourImage(std::string_view bytes, const std::string& name) {
  return colourFromBgr(decodeImage(bytes, name, cv::IMREAD_COLOR));
}

GrayImage parseGrayImage(std::string_view bytes, const std::string& name) {
  return toGray(parseColourImage(bytes, name));
}

Mask parseMask(std::string_view bytes, const std::string& name) {
  const cv::Mat image = decodeImage(bytes, name, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
  const bool is_jpeg = inspectImage(bytes, name).form == ImageForm::kJpeg;
  const cv::Mat marked = largestChannel(image) >= (is_jpeg ? kJpegMaskThreshold : 1e-6);
  Mask out(marked.cols, marked.rows);
  marked.copyTo(cv::Mat(marked.rows, marked.cols, CV_8U, out.values.data()));
  return out;
}

ColourImage readColourImage(const std::filesystem::path& file) {
  return parseColourImage(readBytes(file), shown(file));
}
GrayImage readGrayImage(const std::filesystem::path& file) {
  return parseGrayImage(readBytes(file), shown(file));
}
Mask readMask(const std::filesystem::path& file) { return parseMask(readBytes(file), shown(file)); }

}  // namespace softscope
