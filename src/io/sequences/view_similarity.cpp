#include "io/sequences/view_similarity.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "io/images/image_codec.h"

namespace softscope {
namespace {

constexpr int kWorkWidthPx = 128;
constexpr double kShadingSigmaPx = 5;

/// Downsampled grey image without low frequencies.
cv::Mat detailsOf(const ColourImage& image) {
  const GrayImage gray = toGray(image);
  const int height = std::max(1, gray.height_px * kWorkWidthPx / gray.width_px);
  cv::Mat small, shading;
  cv::resize(matrixView(gray, CV_8U), small, {kWorkWidthPx, height}, 0, 0, cv::INTER_AREA);
  small.convertTo(small, CV_32F);
  cv::GaussianBlur(small, shading, {}, kShadingSigmaPx);
  return small - shading;
}

double correlation(const cv::Mat& a, const cv::Mat& b) {
  const double energy = cv::norm(a) * cv::norm(b);
  return energy > 0 ? a.dot(b) / energy : 0;
}

}  // namespace

ViewSimilarity viewSimilarity(const ColourImage& a, const ColourImage& b) {
  const cv::Mat left = detailsOf(a), right = detailsOf(b);
  ViewSimilarity out;
  out.unshifted = out.best = correlation(left, right);
  for (int shift = 1; shift <= kWorkWidthPx / 4; ++shift) {
    const cv::Range ahead(shift, kWorkWidthPx), behind(0, kWorkWidthPx - shift);
    const auto columns = [](const cv::Mat& m, const cv::Range& range) {
      return m(cv::Range::all(), range).clone();
    };
    out.best = std::max({out.best, correlation(columns(left, ahead), columns(right, behind)),
                         correlation(columns(left, behind), columns(right, ahead))});
  }
  return out;
}

}  // namespace softscope
