#include "features/mask_morphology.h"

#include <opencv2/imgproc.hpp>

namespace softscope {
namespace {

cv::Mat viewOf(const Mask& mask) {
  return {mask.height_px, mask.width_px, CV_8U, const_cast<std::uint8_t*>(mask.values.data())};
}

cv::Mat square(int radius_px) {
  return cv::getStructuringElement(cv::MORPH_RECT, {2 * radius_px + 1, 2 * radius_px + 1});
}

}  // namespace

Mask grown(const Mask& mask, int radius_px) {
  Mask out(mask.width_px, mask.height_px, 0);
  if (mask.empty()) return out;
  cv::Mat to = viewOf(out);
  cv::dilate(viewOf(mask) != 0, to, square(radius_px));
  for (std::uint8_t& value : out.values) value = value != 0;
  return out;
}

Mask shrunk(const Mask& mask, int radius_px) {
  Mask out(mask.width_px, mask.height_px, 0);
  if (mask.empty()) return out;
  cv::Mat to = viewOf(out);
  cv::erode(viewOf(mask) != 0, to, square(radius_px));
  for (std::uint8_t& value : out.values) value = value != 0;
  return out;
}

}  // namespace softscope
