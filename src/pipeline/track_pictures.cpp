#include "pipeline/track_pictures.h"

namespace softscope {

void TrackPictures::prepare() {
  end();
  making_ = std::async(std::launch::async, [this] { return make(); });
}

const TrackPictures::Pictures& TrackPictures::pictures() {
  if (!pictures_) pictures_ = std::make_unique<Pictures>(making_.valid() ? making_.get() : make());
  return *pictures_;
}

void TrackPictures::end() {
  if (making_.valid()) making_.wait();
  making_ = {};
  pictures_.reset();
}

TrackPictures::Pictures TrackPictures::make() const {
  return {LookPicture(frame_->live.gray, frame_->live.ignore),
          TrackSight(*frame_, *rig_).reliefPx()};
}

}  // namespace softscope
