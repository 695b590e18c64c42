#include "features/instrument_detector.h"

#include <opencv2/imgproc.hpp>

#include "core/mask_morphology.h"
#include "core/parallel.h"

namespace softscope {
namespace {

constexpr double kInstrumentRedness = -0.02;   // largest (R - (G + B) / 2) / (R + G + B)
constexpr int kLeastColourBrightness = 25;     // mean of the channels; darker has no colour
constexpr int kInstrumentOpenPx = 4;           // candidates narrower than twice this are dropped
constexpr int kInstrumentClosePx = 6;          // holes narrower than twice this are filled
constexpr double kInstrumentAreaShare = 0.01;  // least, of the image
constexpr int kInstrumentBorderGapPx = 8;      // an instrument begins this near to the border
constexpr int kInstrumentRimPx = 10;           // dilation: the shadowed rim is masked too

/// 3 x 3 box means, because chroma of single pixels is dominated by JPEG blocks.
ColourImage softened(const ColourImage& image) {
  ColourImage out(image.width_px, image.height_px);
  const cv::Mat from(image.height_px, image.width_px, CV_8UC3,
                     const_cast<Rgb8*>(image.values.data()));
  cv::Mat to(out.height_px, out.width_px, CV_8UC3, out.values.data());
  cv::blur(from, to, {5, 5});
  return out;
}

Mask colourlessPixels(const ColourImage& image) {
  Mask mask(image.width_px, image.height_px, 0);
  parallelRows(image.height_px, [&](int v) {
    const Rgb8* in = image.row(v);
    for (int u = 0; u < image.width_px; ++u) {
      const int sum = in[u].red + in[u].green + in[u].blue;
      const double redness = in[u].red - 0.5 * (in[u].green + in[u].blue);
      mask.at(u, v) = sum >= 3 * kLeastColourBrightness && redness <= kInstrumentRedness * sum;
    }
  });
  return mask;
}

/// Keeps connected regions that are large and begin at the border.
Mask largeFromBorder(const Mask& mask) {
  const cv::Mat from(mask.height_px, mask.width_px, CV_8U,
                     const_cast<std::uint8_t*>(mask.values.data()));
  cv::Mat labels, boxes, centres;
  const int count = cv::connectedComponentsWithStats(from, labels, boxes, centres, 8, CV_32S);
  const double least = kInstrumentAreaShare * mask.width_px * mask.height_px;
  std::vector<std::uint8_t> kept(static_cast<std::size_t>(count), 0);
  for (int i = 1; i < count; ++i) {
    const int* box = boxes.ptr<int>(i);
    const int right = box[cv::CC_STAT_LEFT] + box[cv::CC_STAT_WIDTH];
    const int bottom = box[cv::CC_STAT_TOP] + box[cv::CC_STAT_HEIGHT];
    const int gap = std::min({box[cv::CC_STAT_LEFT], box[cv::CC_STAT_TOP], mask.width_px - right,
                              mask.height_px - bottom});
    kept[static_cast<std::size_t>(i)] =
        box[cv::CC_STAT_AREA] >= least && gap <= kInstrumentBorderGapPx;
  }
  Mask out(mask.width_px, mask.height_px, 0);
  for (int v = 0; v < mask.height_px; ++v)
    for (int u = 0; u < mask.width_px; ++u)
      out.at(u, v) = kept[static_cast<std::size_t>(labels.at<int>(v, u))];
  return out;
}

}  // namespace

Mask detectInstruments(const ColourImage& image) {
  if (image.empty()) return Mask();
  const Mask colourless = colourlessPixels(softened(image));
  const Mask opened = dilated(eroded(colourless, kInstrumentOpenPx), kInstrumentOpenPx);
  const Mask closed = eroded(dilated(opened, kInstrumentClosePx), kInstrumentClosePx);
  return dilated(largeFromBorder(closed), kInstrumentRimPx);
}

}  // namespace softscope
