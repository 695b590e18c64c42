// src/io/images/video_writer.cpp: encoder of OpenCV with a temporary file name.
#include "io/images/video_writer.h"

#include <unistd.h>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/images/image_codec.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// Hidden file next to the target with its extension, which selects the container.
fs::path partOf(const fs::path& target) {
  return target.parent_path() /
         say(".", target.stem().string(), ".", getpid(), ".part", target.extension().string());
}

/// Number of readable frames.
int framesIn(const fs::path& video) {
  int frames = 0;
  try {
    cv::VideoCapture capture(video.string(), cv::CAP_FFMPEG);
    while (capture.isOpened() && capture.grab()) ++frames;
  } catch (const cv::Exception&) {  // unreadable: no frame
  }
  return frames;
}

}  // namespace

struct VideoWriter::State {
  fs::path target, part;
  bool overwrite = false;
  cv::Size size;
  cv::VideoWriter encoder;
  int frames = 0;

  bool open(int code, double frames_per_second) {
    try {
      return encoder.open(part.string(), cv::CAP_FFMPEG, code, frames_per_second, size, true);
    } catch (const cv::Exception&) {
      return false;
    }
  }
};

VideoWriter::VideoWriter(fs::path target, int width_px, int height_px, double frames_per_second,
                         bool overwrite)
    : state_(std::make_unique<State>()) {
  requireWritable(target, overwrite);
  state_->part = partOf(target);
  state_->target = std::move(target);
  state_->overwrite = overwrite;
  state_->size = cv::Size(width_px, height_px);
  if (state_->open(cv::VideoWriter::fourcc('a', 'v', 'c', '1'), frames_per_second) ||
      state_->open(cv::VideoWriter::fourcc('m', 'p', '4', 'v'), frames_per_second))
    return;
  std::error_code ignored;
  fs::remove(state_->part, ignored);
  throw Error(say(shown(state_->target), ": a video of ", width_px, " x ", height_px,
                  " pixels can't be written; is the folder there, and are both numbers even? "
                  "Else write images."));
}

VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;

VideoWriter::~VideoWriter() {
  if (!state_) return;
  state_->encoder.release();
  std::error_code ignored;
  fs::remove(state_->part, ignored);
}

void VideoWriter::add(const ColourImage& picture) {
  if (picture.width_px != state_->size.width || picture.height_px != state_->size.height)
    throw Error(say(shown(state_->target), ": an image of ", picture.width_px, " x ",
                    picture.height_px, " pixels, but the video has ", state_->size.width, " x ",
                    state_->size.height));
  cv::Mat bgr;
  cv::cvtColor(matrixView(picture, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  state_->encoder.write(bgr);
  ++state_->frames;
}

void VideoWriter::finish() {
  state_->encoder.release();
  if (const int found = framesIn(state_->part); found != state_->frames)
    throw Error(say(shown(state_->target), ": can't be written: of ", state_->frames,
                    " images the video holds ", found, ". Is the disk full? Free some space."));
  requireWritable(state_->target, state_->overwrite);
  std::error_code failed;
  fs::rename(state_->part, state_->target, failed);
  if (failed) throw Error(shown(state_->target) + ": " + failed.message() + "; is the disk full?");
}

}  // namespace softscope
