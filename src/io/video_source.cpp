#include "io/video_source.h"

#include <cmath>
#include <opencv2/videoio.hpp>

#include "core/error.h"
#include "io/image_codec.h"
#include "io/message.h"
#include "io/picture_limits.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

cv::VideoCapture openCapture(const fs::path& file) {
  cv::VideoCapture capture;
  try {
    // FFmpeg alone: other back ends would take a name for a pattern or a device.
    capture.open(file.string(), cv::CAP_FFMPEG);
    capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // a calibration speaks of stored pixels
  } catch (const cv::Exception&) {
  }
  if (!capture.isOpened())
    throw InputError(shown(file) +
                     ": the video can't be opened; it is damaged, or its codec is not "
                     "known here. Convert it (ffmpeg -i IN -c:v libx264 -crf 12 OUT.mp4).");
  return capture;
}

/// The header's count where it has one, else by decoding all.
int countFrames(const fs::path& file, cv::VideoCapture& capture) {
  const double promised = capture.get(cv::CAP_PROP_FRAME_COUNT);
  if (promised >= 1 && promised < 1e9) return static_cast<int>(std::lround(promised));
  cv::VideoCapture counter = openCapture(file);
  int count = 0;
  while (counter.grab()) ++count;
  if (count == 0) throw InputError(shown(file) + ": the video holds no frame. Copy it again.");
  return count;
}

class Video : public PictureSource {
 public:
  explicit Video(const fs::path& file)
      : name_(shown(file)), capture_(openCapture(file)), count_(countFrames(file, capture_)) {}

  int count() const override { return count_; }
  std::string nameOf(int index) const override { return say(name_, ", frame ", index); }
  double framesPerSecond() const override {
    const double rate_hz = capture_.get(cv::CAP_PROP_FPS);
    return rate_hz > 0 && rate_hz < 1e4 ? rate_hz : 0;
  }
  bool survivesErrors() const override { return false; }

  ColourImage read(int index) override {
    for (; next_ < index; ++next_)
      if (!grab()) fail();
    cv::Mat bgr;
    if (!grab() || !capture_.retrieve(bgr) || bgr.type() != CV_8UC3) fail();
    ++next_;
    requirePictureSize(bgr.cols, bgr.rows, nameOf(index));
    return colourFromBgr(bgr);
  }

 private:
  bool grab() {
    try {
      return capture_.grab();
    } catch (const cv::Exception&) {
      return false;
    }
  }
  [[noreturn]] void fail() const {
    throw InputError(say(name_, ": frame ", next_, " can't be decoded, but the header promises ",
                         count_,
                         " frames. The video is truncated or damaged: copy it again, or use ",
                         "--frames 0:", next_, "."));
  }

  std::string name_;
  cv::VideoCapture capture_;
  int count_;
  int next_ = 0;  // the frame that the next grab gives
};

}  // namespace

std::unique_ptr<PictureSource> openVideo(const fs::path& file) {
  return std::make_unique<Video>(file);
}

}  // namespace softscope
