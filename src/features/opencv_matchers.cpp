#include "features/opencv_matchers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/features2d.hpp>
#include <opencv2/video/tracking.hpp>

#include "features/match_consistency.h"
#include "features/subpixel_match.h"

namespace softscope {
namespace {

/// OpenCV has no read-only view; nothing writes through this one.
cv::Mat viewOf(const GrayImage& image) {
  return {image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.values.data())};
}

struct KeyPoints {
  std::vector<cv::KeyPoint> places;
  cv::Mat descriptors;
};

KeyPoints siftOf(cv::SIFT& sift, const MatchPicture& picture) {
  KeyPoints points;
  cv::Mat wanted;
  if (!picture.ignore.empty()) wanted = viewOf(picture.ignore) == 0;
  sift.detectAndCompute(viewOf(picture.gray), wanted, points.places, points.descriptors);
  return points;
}

/// Nearest of `to` for each key point of `from`, within the radius; -1 where the ratio test fails.
std::vector<int> nearestWithin(const KeyPoints& from, const KeyPoints& to, float radius_px,
                               double max_ratio) {
  std::vector<int> nearest(from.places.size(), -1);
  cv::parallel_for_({0, static_cast<int>(from.places.size())}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      float best = std::numeric_limits<float>::max(), second = best;
      const cv::Point2f at = from.places[static_cast<std::size_t>(i)].pt;
      for (int j = 0; j < to.descriptors.rows; ++j) {
        const cv::Point2f there = to.places[static_cast<std::size_t>(j)].pt;
        if (std::hypot(there.x - at.x, there.y - at.y) > radius_px) continue;
        const float distance = static_cast<float>(
            cv::norm(from.descriptors.row(i), to.descriptors.row(j), cv::NORM_L2));
        if (distance < best) {
          second = best;
          best = distance;
          nearest[static_cast<std::size_t>(i)] = j;
        } else {
          second = std::min(second, distance);
        }
      }
      if (!(best < max_ratio * second)) nearest[static_cast<std::size_t>(i)] = -1;
    }
  });
  return nearest;
}

class SiftMatcher : public FeatureMatcher {
 public:
  explicit SiftMatcher(const MatcherOptions& options)
      : options_(options), sift_(cv::SIFT::create(options.kSiftFeatures)) {}
  std::string name() const override { return MatcherOptions::kSift; }

  std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) override {
    std::vector<PixelMatch> matches;
    if (model.gray.empty()) return matches;
    const KeyPoints a = siftOf(*sift_, model), b = siftOf(*sift_, live);
    const float radius_px = static_cast<float>(options_.reach) *
                            static_cast<float>(std::max(model.gray.width_px, model.gray.height_px));
    const std::vector<int> there = nearestWithin(a, b, radius_px, options_.kMaxRatio);
    const std::vector<int> back = nearestWithin(b, a, radius_px, options_.kMaxRatio);
    for (std::size_t i = 0; i < there.size(); ++i) {
      if (there[i] < 0 || back[static_cast<std::size_t>(there[i])] != static_cast<int>(i)) continue;
      const cv::Point2f p = a.places[i].pt, q = b.places[static_cast<std::size_t>(there[i])].pt;
      matches.push_back({{p.x, p.y}, {q.x, q.y}, 0.5f, 0});
    }
    return matches;
  }

 private:
  MatcherOptions options_;
  cv::Ptr<cv::SIFT> sift_;
};

class FlowMatcher : public FeatureMatcher {
 public:
  explicit FlowMatcher(const MatcherOptions& options)
      : options_(options), flow_(cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)) {}
  std::string name() const override { return MatcherOptions::kDisFlow; }

  std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) override {
    std::vector<PixelMatch> rough;
    constexpr int kSmallestSide = 32;  // DIS divides by the size of its coarsest level
    if (model.gray.width_px < kSmallestSide || model.gray.height_px < kSmallestSide) return rough;
    cv::Mat flow;
    flow_->calc(viewOf(model.gray), viewOf(live.gray), flow);
    const int step = options_.kSpacingPx;
    for (int v = step / 2; v < flow.rows; v += step)
      for (int u = step / 2; u < flow.cols; u += step) {
        const cv::Vec2f shift = flow.at<cv::Vec2f>(v, u);
        const float to_u = static_cast<float>(u) + shift[0],
                    to_v = static_cast<float>(v) + shift[1];
        if (usable(model, u, v) && std::isfinite(to_u) && std::isfinite(to_v) &&
            usable(live, static_cast<int>(std::lround(to_u)), static_cast<int>(std::lround(to_v))))
          rough.push_back({Eigen::Vector2f(u, v), {to_u, to_v}, 0.5f, 0});
      }
    return options_.subpixel.method == "gauss-newton"
               ? keepConsistent(refineMatches(model, live, rough, options_.subpixel),
                                options_.consistency)
               : rough;
  }

 private:
  static bool usable(const MatchPicture& picture, int u, int v) {
    return picture.gray.contains(u, v) && (picture.ignore.empty() || picture.ignore.at(u, v) == 0);
  }

  MatcherOptions options_;
  cv::Ptr<cv::DISOpticalFlow> flow_;
};

}  // namespace

std::unique_ptr<FeatureMatcher> makeSiftMatcher(const MatcherOptions& options) {
  return std::make_unique<SiftMatcher>(options);
}

std::unique_ptr<FeatureMatcher> makeFlowMatcher(const MatcherOptions& options) {
  return std::make_unique<FlowMatcher>(options);
}

}  // namespace softscope
