// src/stereo/images/opencv_view.h: rasters as OpenCV matrices, without a copy.
#pragma once

#include <opencv2/core.hpp>

#include "core/image.h"

namespace softscope {

inline cv::Mat opencvView(GrayImage& image) {
  return {image.height_px, image.width_px, CV_8U, image.values.data()};
}
inline cv::Mat opencvView(ColourImage& image) {
  static_assert(sizeof(Rgb8) == 3, "three bytes a pixel");
  return {image.height_px, image.width_px, CV_8UC3, image.values.data()};
}
inline cv::Mat opencvView(Raster<float>& raster) {
  return {raster.height_px, raster.width_px, CV_32F, raster.values.data()};
}

/// OpenCV has no view of constant data; the caller must not write through it.
template <class T>
cv::Mat opencvView(const Raster<T>& raster) {
  return opencvView(const_cast<Raster<T>&>(raster));
}

}  // namespace softscope
