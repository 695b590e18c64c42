#include "io/images/image_codec.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "io/images/image_header.h"
#include "io/images/jpeg_damage.h"
#include "io/text/message.h"

namespace softscope {
namespace {

cv::Mat decodeOrEmpty(std::string_view bytes, int flags) {
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  try {
    return cv::imdecode(raw, flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

cv::Mat decodeImage(std::string_view bytes, const std::string& name, int flags) {
  const ImageHeader header = inspectImage(bytes, name);
  if (header.form == ImageForm::kJpeg) {
    cv::Mat bgr;
    if (flags == cv::IMREAD_COLOR) bgr.create(header.height_px, header.width_px, CV_8UC3);
    if (!bgr.empty() && decodeSoundJpeg(bytes, name, header.width_px, header.height_px, bgr.data))
      return bgr;
    requireSoundJpeg(bytes, name);
  }
  cv::Mat image = decodeOrEmpty(bytes, flags);
  if (image.cols != header.width_px || image.rows != header.height_px)
    throw InputError(name +
                     ": the image can't be decoded, it is damaged or of an unusual kind. "
                     "Export it again as PNG.");
  return image;
}

std::string encodeImage(const char* extension, const cv::Mat& image,
                        const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  try {
    if (cv::imencode(extension, image, bytes, parameters)) return {bytes.begin(), bytes.end()};
  } catch (const cv::Exception&) {
  }
  throw Error(say("an image of ", image.cols, " x ", image.rows, " pixels can't be encoded as ",
                  extension, "."));
}

ColourImage colourFromBgr(const cv::Mat& bgr) {
  static_assert(sizeof(Rgb8) == 3, "three bytes a pixel");
  ColourImage out(bgr.cols, bgr.rows);
  cv::Mat view(bgr.rows, bgr.cols, CV_8UC3, out.values.data());
  cv::cvtColor(bgr, view, cv::COLOR_BGR2RGB);
  return out;
}

}  // namespace softscope
