// vtk_views/viewer/view_sheet.cpp: slider, three
// columns of text and bars; one point is one pixel.
#include "vtk_views/viewer/view_sheet.h"

#include <algorithm>
#include <cstdio>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/scenes/slice_panel.h"

namespace softscope {
namespace {

constexpr double kPixelsPerInch = 72;  // one point is one pixel
constexpr double kSheetMargin = 14, kFont = 13, kSmall = 11;
constexpr double kTrack = 15;  // height of the slider in the foot
constexpr Rgb8 kSheetDark{20, 20, 20}, kSheetPale{200, 200, 200}, kSheetGrey{110, 110, 110},
    kSheetBlue{0, 110, 170};
constexpr Rgb8 kLiveRed{200, 30, 35};

DrawnText textAt(PointPt at, std::string words, double size_pt, Rgb8 colour) {
  DrawnText text;
  text.at = at;
  text.text = std::move(words);
  text.size_pt = size_pt;
  text.colour = colour;
  return text;
}

double placeX(double place, double width) {
  return kSheetMargin + place * (width - 2 * kSheetMargin);
}

void drawSlider(const ViewFoot& foot, VectorDrawing& sheet) {
  const double width = sheet.width_pt;
  const double at = placeX(foot.places[std::size_t(foot.index)], width);
  sheet.parts.emplace_back(
      DrawnLine{{{kSheetMargin, kTrack}, {width - kSheetMargin, kTrack}}, 3, kSheetPale});
  sheet.parts.emplace_back(DrawnLine{{{kSheetMargin, kTrack}, {at, kTrack}}, 3, kSheetBlue});
  if (foot.places.size() <= 200)
    for (const double place : foot.places) {
      const double x = placeX(place, width);
      sheet.parts.emplace_back(DrawnLine{{{x, kTrack + 4}, {x, kTrack + 8}}, 1, kSheetGrey});
    }
  sheet.parts.emplace_back(DrawnDots{{{at, kTrack}}, 13, kSheetBlue});
}

void drawWords(const ViewFoot& foot, VectorDrawing& sheet) {
  const double first = kSliderPx + 18;
  DrawnText title = textAt({kSheetMargin, first}, foot.title, kFont, kSheetDark);
  title.bold = true;
  const double title_end = kSheetMargin + textWidthPt(title);
  sheet.parts.emplace_back(std::move(title));
  DrawnText going = textAt({title_end + 10, first}, foot.going, kFont,
                           foot.going == "live" ? kLiveRed : kSheetDark);
  going.bold = true;
  if (!foot.going.empty()) sheet.parts.emplace_back(std::move(going));
  sheet.parts.emplace_back(textAt({kSheetMargin, first + 17}, foot.status, kSmall, kSheetDark));
  sheet.parts.emplace_back(
      textAt({kSheetMargin, first + 33},
             foot.view + (foot.of_window ? "   h: keys" : "") + "   research use only", kSmall,
             kSheetGrey));
}

void drawBars(const ViewFoot& foot, VectorDrawing& sheet) {
  const double bar_width = std::min(300.0, 0.36 * sheet.width_pt);
  const double bar_left = sheet.width_pt - kSheetMargin - bar_width;
  if (std::isfinite(foot.width_mm)) {
    // A panel of the width of the view gives the correct scale; its left end has free space.
    const double length = scaleBarLengthMm(foot.width_mm) / foot.width_mm * sheet.width_pt;
    const double left = std::max(bar_left - 30 - length, 0.36 * sheet.width_pt);
    FigureStyle style;
    style.font_pt = kSmall;
    style.line_pt = 1.6;
    const PanelPlace place{{left, kSliderPx}, sheet.width_pt, kViewFootPx - kSliderPx - 22.0};
    drawScaleBar(foot.width_mm, place, kSheetDark, style, sheet);
  }
  if (foot.colours) {
    drawColourBar(*foot.colours, foot.bar, {bar_left, kSliderPx + 6.0}, bar_width, kSmall, sheet);
    return;
  }
  DrawnText text =
      textAt({sheet.width_pt - kSheetMargin, kSliderPx + 18.0}, foot.colour, kSmall, kSheetDark);
  text.anchor = TextAnchor::kEnd;
  sheet.parts.emplace_back(std::move(text));
}

std::string grouped(std::size_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, " ");
  return text;
}

std::string titleOf(const ViewMoment& moment) {
  char text[64];
  std::snprintf(text, sizeof text, std::isfinite(moment.time_s) ? "frame %d, %.2f s" : "frame %d",
                moment.frame, moment.time_s);
  return text;
}

std::string statusOf(const ViewSource& source, const ViewMoment& moment, const Playback& playback) {
  return "model " + std::to_string(playback.index() + 1) + " of " + std::to_string(source.count()) +
         ", " + grouped(moment.model.vertices_mm.size()) + " points";
}

std::string playingText(const Playback& playback) {
  char speed[32] = "";
  if (playback.speed != 1) std::snprintf(speed, sizeof speed, ", %g× speed", playback.speed);
  return std::string(playback.playing ? "; playing" : "; paused") + speed +
         (playback.looping ? ", loop" : "");
}

std::string viewName(const ViewWorld& world, Look look) {
  const bool patient = world.frame == SceneFrame::kPatient;
  switch (look) {
    case Look::kScope:
      return "the scope's own view";
    case Look::kFront:
      return patient ? "axial, from the feet" : "from the first frame's side";
    case Look::kAbove:
      return patient ? "coronal, from the front" : "from above";
    case Look::kRight:
      return patient ? "sagittal, from the left" : "from the right";
    case Look::kFree:
      break;
  }
  return "free view";
}

void addColour(const ViewWorld& world, const ViewMoment& moment, const ViewState& state,
               ViewFoot& foot) {
  foot.colour = "colour: texture";
  if (state.colour == ViewColour::kWeights && !moment.weights.empty()) {
    foot.colours = ErrorColours{false, world.largest_weight};
    foot.bar.label = "weight: how often, how well seen";
  } else if (state.colour == ViewColour::kErrors && moment.errors_mm.empty()) {
    foot.colour = "no errors are known of this frame";
  } else if (state.colour == ViewColour::kErrors) {
    foot.colours = world.errors;
    foot.bar.label = world.error_label;
    for (const double error_mm : moment.errors_mm) {
      foot.bar.any_above |= error_mm > world.errors.limit_mm;
      foot.bar.any_below |= error_mm < world.errors.low_mm();
      foot.bar.any_missing |= std::isnan(error_mm);
    }
  }
}

}  // namespace

ViewFoot footOf(const ViewSource& source, const ViewMoment& moment, const Playback& playback,
                const ViewState& state, double width_mm, bool of_window) {
  ViewFoot foot;
  foot.of_window = of_window;
  const int count = source.count();
  const double first_s = source.secondsOf(0), span_s = source.secondsOf(count - 1) - first_s;
  for (int i = 0; i < count; ++i)
    foot.places.push_back(span_s > 0 ? (source.secondsOf(i) - first_s) / span_s : 0);
  foot.index = playback.index();
  foot.title = titleOf(moment);
  foot.status = statusOf(source, moment, playback);
  if (of_window) foot.status += playingText(playback);
  foot.view = viewName(source.world(), state.look);
  if (state.motion && moment.moved_since >= 0)
    foot.view += ", arrows: 4× the motion since frame " + std::to_string(moment.moved_since);
  if (source.live()) foot.going = source.stopped() ? "stopped" : "live";
  foot.width_mm = width_mm;
  addColour(source.world(), moment, state, foot);
  return foot;
}

ColourImage drawViewFoot(const ViewFoot& foot, int width_px, double scale) {
  VectorDrawing sheet;
  sheet.width_pt = width_px / scale;
  sheet.height_pt = kViewFootPx;
  drawSlider(foot, sheet);
  drawWords(foot, sheet);
  drawBars(foot, sheet);
  return rasterise(sheet, kPixelsPerInch * scale);
}

double sliderPlace(int x_px, int width_px) {
  return std::clamp((x_px - kSheetMargin) / (width_px - 2 * kSheetMargin), 0.0, 1.0);
}

int nearestMoment(const std::vector<double>& places, double place) {
  const auto above = std::lower_bound(places.begin(), places.end(), place);
  if (above == places.begin()) return 0;
  if (above == places.end()) return static_cast<int>(places.size()) - 1;
  const auto index = static_cast<int>(above - places.begin());
  return place - above[-1] < *above - place ? index - 1 : index;
}

ColourImage drawViewHelp() {
  constexpr double kRowPt = 19, kKeys = 130, kWidthPt = 500;
  VectorDrawing sheet;
  sheet.width_pt = kWidthPt;
  sheet.height_pt = kRowPt * double(viewKeys().size()) + 24;
  const double w = sheet.width_pt - 0.5, h = sheet.height_pt - 0.5;
  sheet.parts.emplace_back(
      DrawnLine{{{0.5, 0.5}, {w, 0.5}, {w, h}, {0.5, h}, {0.5, 0.5}}, 1, kSheetGrey});
  double y = 12 + kFont;
  for (const auto& [keys, meaning] : viewKeys()) {
    DrawnText name = textAt({kSheetMargin, y}, keys, 12, kSheetDark);
    name.bold = true;
    sheet.parts.emplace_back(std::move(name));
    sheet.parts.emplace_back(textAt({kSheetMargin + kKeys, y}, meaning, 12, kSheetDark));
    y += kRowPt;
  }
  return rasterise(sheet, kPixelsPerInch);
}

ColourImage composeView(const ColourImage& top, const ColourImage& bottom,
                        const ColourImage* card) {
  ColourImage all(top.width_px, top.height_px + bottom.height_px);
  std::copy(top.values.begin(), top.values.end(), all.values.begin());
  std::copy(bottom.values.begin(), bottom.values.end(),
            all.values.begin() + std::ptrdiff_t(top.values.size()));
  if (card == nullptr) return all;
  const int left = (top.width_px - card->width_px) / 2;
  const int above = (top.height_px - card->height_px) / 2;
  for (int v = 0; v < card->height_px; ++v)
    for (int u = 0; u < card->width_px; ++u)
      if (left + u >= 0 && left + u < all.width_px && above + v >= 0 && above + v < all.height_px)
        all.at(left + u, above + v) = card->at(u, v);
  return all;
}

}  // namespace softscope
