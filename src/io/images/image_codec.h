// src/io/images/image_codec.h: OpenCV's image codecs with own checks and errors.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Decodes with `flags` of cv::imdecode
/// after inspectImage(). Throws InputError.
cv::Mat decodeImage(std::string_view bytes, const std::string& name, int flags);

/// `extension`: ".png", ".jpg", ".tif". `parameters`: as in cv::imencode. Throws Error.
std::string encodeImage(const char* extension, const cv::Mat& image,
                        const std::vector<int>& parameters = {});

/// OpenCV's BGR, 8 bits, to RGB.
ColourImage colourFromBgr(const cv::Mat& bgr);

/// Read-only matrix view of a raster.
template <class T>
cv::Mat matrixView(const Raster<T>& raster, int type) {
  return {raster.height_px, raster.width_px, type, const_cast<T*>(raster.values.data())};
}

}  // namespace softscope
