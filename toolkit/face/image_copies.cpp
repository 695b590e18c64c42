#include "toolkit/face/image_copies.h"

#include <cstring>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope::api {

namespace {

void requireSize(int width_px, int height_px, const PinholeCamera& camera, const char* what) {
  if (width_px == camera.width_px && height_px == camera.height_px) return;
  throw InputError(say(what, ": is ", width_px, " x ", height_px, " px, but the calibration is of ",
                       camera.width_px, " x ", camera.height_px, " px"));
}

}  // namespace

static_assert(sizeof(Rgb8) == 3, "rows of Rgb8 are rows of bytes");

ColourImage colourImageOf(const ImageView& view, const char* what) {
  if (view.values == nullptr || view.width_px <= 0 || view.height_px <= 0)
    throw InputError(say(what, ": is empty; give an image of the left and of the right camera"));
  if (view.channels != 1 && view.channels != 3)
    throw InputError(say(what, ": has ", view.channels, " channels; give 1 or 3 (RGB)"));
  ColourImage image(view.width_px, view.height_px);
  if (view.channels == 3) {
    std::memcpy(image.values.data(), view.values, 3 * image.size());
    return image;
  }
  for (std::size_t i = 0; i < image.size(); ++i)
    image.values[i] = {view.values[i], view.values[i], view.values[i]};
  return image;
}

Mask maskOf(const ImageView& view) {
  if (view.values == nullptr) return {};
  if (view.channels != 1) throw InputError(say("mask: has ", view.channels, " channels; give one"));
  Mask mask(view.width_px, view.height_px);
  mask.values.assign(view.values, view.values + mask.size());
  return mask;
}

Image imageOf(const ColourImage& image) {
  Image copy{image.width_px, image.height_px, 3, {}};
  copy.values.resize(3 * image.size());
  if (!image.empty()) std::memcpy(copy.values.data(), image.values.data(), copy.values.size());
  return copy;
}

Image imageOf(const Mask& mask) { return {mask.width_px, mask.height_px, 1, mask.values}; }

const StereoCalibration& sized(const StereoCalibration& calibration) {
  if (calibration.left.pinhole.width_px > 0) return calibration;
  throw InputError(calibration.source +
                   ": the size of the images is unknown; give width_px and height_px");
}

void requireFit(const StereoCalibration& sequence, const StereoCalibration& calibration) {
  const PinholeCamera &left = sequence.left.pinhole, &right = sequence.right.pinhole;
  requireSize(left.width_px, left.height_px, calibration.left.pinhole, "sequence, left");
  requireSize(right.width_px, right.height_px, calibration.right.pinhole, "sequence, right");
}

softscope::Frame frameOf(const FrameView& view, const StereoCalibration& calibration, int index) {
  softscope::Frame frame;
  frame.index = index;
  frame.time_s = view.time_s;
  frame.pair = {colourImageOf(view.left, "left"), colourImageOf(view.right, "right")};
  frame.mask = maskOf(view.mask);
  const PinholeCamera& left = calibration.left.pinhole;
  requireSize(view.left.width_px, view.left.height_px, left, "left");
  requireSize(view.right.width_px, view.right.height_px, calibration.right.pinhole, "right");
  if (!frame.mask.empty()) requireSize(frame.mask.width_px, frame.mask.height_px, left, "mask");
  return frame;
}

}  // namespace softscope::api
