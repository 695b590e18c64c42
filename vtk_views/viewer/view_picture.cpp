// vtk_views/viewer/view_picture.cpp: supersampled view above the foot.
#include "vtk_views/viewer/view_picture.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "vtk_views/scenes/offscreen_window.h"
#include "vtk_views/scenes/window_pixels.h"
#include "vtk_views/viewer/moment_between.h"
#include "vtk_views/viewer/view_sheet.h"

namespace softscope {
namespace {

constexpr int kPictureFiner = 2;
constexpr double kUsualWidth = 960, kUsualHeight = 720;
constexpr int kLeastWidth = 320, kLeastHeight = 240, kMostShown = 4096;

/// Font size proportional to the image. In eighths, so that the foot has whole pixels.
double footScale(int width_px, int height_px) {
  const double larger = std::min(width_px / kUsualWidth, height_px / kUsualHeight);
  return std::max(1.0, std::floor(8 * larger) / 8);
}

}  // namespace

void requireViewSize(int width_px, int height_px) {
  require(width_px >= kLeastWidth && width_px <= kMostShown, "`size=`", width_px,
          "must be 320 to 4096 pixels wide");
  require(height_px >= kLeastHeight && height_px <= kMostShown, "`size=`", height_px,
          "must be 240 to 4096 pixels high");
}

ViewPicture::ViewPicture(ViewSource& source, int width_px, int height_px, bool clean)
    : source_(source),
      foot_scale_(clean ? 0 : footScale(width_px, height_px)),
      width_px_(width_px),
      height_px_(height_px - static_cast<int>(std::lround(kViewFootPx * foot_scale_))),
      scene_(source.world()) {
  requireViewSize(width_px, height_px);
  window_ = makeOffscreenWindow(kPictureFiner * width_px_, kPictureFiner * height_px_);
  window_->AddRenderer(scene_.renderer());
}

ColourImage ViewPicture::draw(const Playback& playback, const ViewState& state, double turn_deg) {
  const auto moment = shownMoment(source_, playback, state.colour == ViewColour::kErrors);
  const double aspect = double(width_px_) / height_px_;
  if (!first_) first_ = moment;
  scene_.show(*moment, state);
  scene_.look(state.look == Look::kScope ? *moment : *first_, state, aspect);
  if (state.look != Look::kScope) scene_.turn(turn_deg);
  scene_.sizeFor(kPictureFiner);
  window_->Render();
  const ColourImage view = readPixels(window_, width_px_, height_px_, kPictureFiner);
  if (foot_scale_ == 0) return view;
  const ViewFoot foot =
      footOf(source_, *moment, playback, state, scene_.widthShownMm(aspect), /*of_window=*/false);
  const ColourImage card = state.help ? drawViewHelp() : ColourImage();
  return composeView(view, drawViewFoot(foot, width_px_, foot_scale_),
                     state.help ? &card : nullptr);
}

}  // namespace softscope
