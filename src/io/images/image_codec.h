// src/io/images/image_codec.h: OpenCV's image codecs with our checks and errors.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Decodes with cv::imdecode's `flags` after inspectImage() has passed the bytes.
/// Throws InputError.
cv::Mat decodeImage(std::string_view bytes, const std::string& name, int flags);

/// `extension`: ".png", ".jpg", ".tif". `parameters`: as of cv::imencode. Throws Error.
std::string encodeImage(const char* extension, const cv::Mat& image,
                        const std::vector<int>& parameters = {});

/// OpenCV's BGR, 8 bits, as our RGB.
ColourImage colourFromBgr(const cv::Mat& bgr);

/// A raster as a matrix, without a copy and for reading alone.
template <class T>
cv::Mat matrixView(const Raster<T>& raster, int type) {
  return {raster.height_px, raster.width_px, type, const_cast<T*>(raster.values.data())};
}

}  // namespace softscope
