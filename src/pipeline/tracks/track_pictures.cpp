#include "pipeline/tracks/track_pictures.h"

namespace softscope {
namespace {

template <class Made, class Make>
const Made& take(std::future<Made>* making, std::optional<Made>* made, const Make& make) {
  if (!*made) *made = making->valid() ? making->get() : make();
  return **made;
}

template <class Made>
void drop(std::future<Made>* making, std::optional<Made>* made) {
  if (making->valid()) making->wait();
  *making = {};
  made->reset();
}

}  // namespace

void TrackPictures::prepare(bool with_looks) {
  end();
  if (with_looks) making_looks_ = std::async(std::launch::async, [this] { return makeLooks(); });
  making_relief_ = std::async(std::launch::async, [this] { return makeRelief(); });
}

const LookPicture& TrackPictures::looks() {
  return take(&making_looks_, &looks_, [this] { return makeLooks(); });
}

const Raster<float>& TrackPictures::reliefPx() {
  return take(&making_relief_, &relief_px_, [this] { return makeRelief(); });
}

void TrackPictures::end() {
  drop(&making_looks_, &looks_);
  drop(&making_relief_, &relief_px_);
}

LookPicture TrackPictures::makeLooks() const {
  return LookPicture(frame_->live.gray, frame_->live.ignore);
}

Raster<float> TrackPictures::makeRelief() const { return frames_->reliefOf(*frame_); }

}  // namespace softscope
