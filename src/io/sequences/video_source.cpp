#include "io/sequences/video_source.h"

#include <cmath>
#include <cstdint>
#include <opencv2/videoio.hpp>
#include <optional>

#include "core/error.h"
#include "io/images/image_codec.h"
#include "io/images/picture_limits.h"
#include "io/sequences/video_frame_size.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

cv::VideoCapture openCapture(const fs::path& file) {
  cv::VideoCapture capture;
  try {
    // FFmpeg only: other back ends would interpret a name as a pattern or device.
    capture.open(file.string(), cv::CAP_FFMPEG);
    capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // a calibration refers to stored pixels
  } catch (const cv::Exception&) {
  }
  if (!capture.isOpened())
    throw InputError(shown(file) +
                     ": the video can't be opened; it is damaged, or its codec is not "
                     "known here. Convert it (ffmpeg -i IN -c:v libx264 -crf 12 OUT.mp4).");
  return capture;
}

/// Count from the header, else by decoding all frames.
int countFrames(const fs::path& file, cv::VideoCapture& capture) {
  const double promised = capture.get(cv::CAP_PROP_FRAME_COUNT);
  if (promised >= 1 && promised < 1e9) return static_cast<int>(std::lround(promised));
  cv::VideoCapture counter = openCapture(file);
  int count = 0;
  while (counter.grab()) ++count;
  if (count == 0) throw InputError(shown(file) + ": the video holds no frame. Copy it again.");
  return count;
}

/// Detects changes of the frame size from the packets of
/// a video. OpenCV then scales or repeats earlier images.
class SizeWatch {
 public:
  explicit SizeWatch(const fs::path& file) : packets_(openCapture(file)) {
    const auto code = static_cast<std::uint32_t>(packets_.get(cv::CAP_PROP_FOURCC));
    for (int i = 0; i < 4; ++i) codec_ += static_cast<char>(code >> 8 * i & 0xff);
    const bool in_order = codec_ == "MJPG" || codec_ == "mjpg";
    ahead_ = in_order ? 0 : kMostReordered;
    open_ = packets_.set(cv::CAP_PROP_FORMAT, -1);
  }

  /// Throws InputError if frame `index` may have another size than the first.
  void requireSameSize(int index, const std::string& name) {
    while (open_ && !changed_ && next_ <= index + ahead_) readPacket();
    if (!changed_) return;
    const int sound = std::max(0, next_ - 1 - ahead_);
    throw InputError(say(
        name, ": the frames change size in mid-stream, from ", first_->width_px, " x ",
        first_->height_px, " to ", changed_->width_px, " x ", changed_->height_px, " px at frame ",
        next_ - 1, ". Convert the video to one size (ffmpeg -i IN -vf scale=", first_->width_px,
        ":", first_->height_px, " OUT.mp4)", sound > 0 ? say(", or use `frames=` 0:", sound) : "",
        "."));
  }

 private:
  static constexpr int kMostReordered = 16;  // frames that H.264 and HEVC may reorder

  void readPacket() {
    cv::Mat packet;
    try {
      open_ = packets_.grab() && packets_.retrieve(packet);
    } catch (const cv::Exception&) {
      open_ = false;
    }
    if (!open_) return;
    ++next_;
    const auto size = statedFrameSize(
        {reinterpret_cast<const char*>(packet.data), packet.total() * packet.elemSize()}, codec_);
    if (size && first_ && !(*size == *first_)) changed_ = size;
    if (size && !first_) first_ = size;
  }

  cv::VideoCapture packets_;
  std::string codec_;
  int ahead_ = 0;
  bool open_ = false;
  int next_ = 0;  // index of the next packet
  std::optional<VideoFrameSize> first_, changed_;
};

class Video : public PictureSource {
 public:
  explicit Video(const fs::path& file)
      : name_(shown(file)),
        capture_(openCapture(file)),
        count_(countFrames(file, capture_)),
        sizes_(file) {}

  int count() const override { return count_; }
  std::string nameOf(int index) const override { return say(name_, ", frame ", index); }
  double framesPerSecond() const override {
    const double rate_hz = capture_.get(cv::CAP_PROP_FPS);
    return rate_hz > 0 && rate_hz < 1e4 ? rate_hz : 0;
  }
  bool survivesErrors() const override { return false; }

  ColourImage read(int index) override {
    sizes_.requireSameSize(index, name_);
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
                         "`frames=` 0:", next_, "."));
  }

  std::string name_;
  cv::VideoCapture capture_;
  int count_;
  SizeWatch sizes_;
  int next_ = 0;  // index of the next grabbed frame
};

}  // namespace

std::unique_ptr<PictureSource> openVideo(const fs::path& file) {
  return std::make_unique<Video>(file);
}

}  // namespace softscope
