#include "io/sequences/stereo_packing.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/error.h"
#include "io/sequences/view_similarity.h"
#include "io/text/message.h"

namespace softscope {
namespace {

constexpr double kLeastAspect = 0.8, kMostAspect = 2.2;
// Measured on 19 pairs of five scopes and scenes in each packing: correct parts have a
// correlation of 0.36 to 0.92, wrong parts with the aspect ratio of a view at most 0.26.
constexpr double kLeastSimilarity = 0.3;
// … neighbouring rows of an ordinary image,
// unshifted, 0.99, of interlaced views at most 0.78.
constexpr double kSameView = 0.93;

const char* nameOf(StereoLayout layout) {
  switch (layout) {
    case StereoLayout::kSideBySide:
      return "side-by-side";
    case StereoLayout::kTopBottom:
      return "top-bottom";
    case StereoLayout::kInterlaced:
      break;
  }
  return "interlaced";
}

/// Rows (or columns) `first`, `first + step`, …
ColourImage part(const ColourImage& image, int u0, int v0, int width, int height, int row_step) {
  ColourImage out(width, height);
  for (int v = 0; v < height; ++v)
    std::copy_n(image.row(v0 + v * row_step) + u0, width, out.row(v));
  return out;
}

Rgb8 mean(const Rgb8& a, const Rgb8& b) {
  const auto half = [](int x, int y) { return static_cast<std::uint8_t>((x + y + 1) / 2); };
  return {half(a.red, b.red), half(a.green, b.green), half(a.blue, b.blue)};
}

/// Rows of one field at their positions; rows between are means of their neighbours.
ColourImage fullHeightField(const ColourImage& image, int first_row) {
  ColourImage out = image;
  for (int v = 1 - first_row; v < image.height_px; v += 2) {
    const int above = v > 0 ? v - 1 : v + 1, below = v + 1 < image.height_px ? v + 1 : v - 1;
    for (int u = 0; u < image.width_px; ++u)
      out.at(u, v) = mean(image.at(u, above), image.at(u, below));
  }
  return out;
}

StereoPair parts(const ColourImage& image, const StereoPacking& packing) {
  const int w = image.width_px, h = image.height_px;
  switch (packing.layout) {
    case StereoLayout::kSideBySide:
      return {part(image, 0, 0, w / 2, h, 1), part(image, w / 2, 0, w / 2, h, 1)};
    case StereoLayout::kTopBottom:
      return {part(image, 0, 0, w, h / 2, 1), part(image, 0, h / 2, w, h / 2, 1)};
    case StereoLayout::kInterlaced:
      break;
  }
  if (packing.full_height) return {fullHeightField(image, 0), fullHeightField(image, 1)};
  return {part(image, 0, 0, w, h / 2, 2), part(image, 0, 1, w, h / 2, 2)};
}

std::optional<StereoLayout> layoutNamed(const std::string& name) {
  for (const StereoLayout layout :
       {StereoLayout::kSideBySide, StereoLayout::kTopBottom, StereoLayout::kInterlaced})
    if (name == nameOf(layout)) return layout;
  if (name == "auto") return std::nullopt;
  throw OptionError(say("sequence.layout is ", excerpt(name),
                        ", but must be auto, side-by-side, top-bottom or interlaced"));
}

bool canPart(const ColourImage& image, StereoLayout layout) {
  return (layout == StereoLayout::kSideBySide ? image.width_px : image.height_px) % 2 == 0;
}

bool hasShapeOfView(double width, double height) {
  return width / height >= kLeastAspect && width / height <= kMostAspect;
}

/// Packings compatible with the sizes.
std::vector<StereoLayout> candidates(const ColourImage& image, const ExpectedView& view) {
  const int w = image.width_px, h = image.height_px;
  const auto fits = [&](int width, int height) {
    if (view.width_px > 0) return width == view.width_px && height == view.height_px;
    return hasShapeOfView(width, height);
  };
  std::vector<StereoLayout> out;
  if (w % 2 == 0 && fits(w / 2, h)) out.push_back(StereoLayout::kSideBySide);
  if (h % 2 == 0 && fits(w, h / 2)) out.push_back(StereoLayout::kTopBottom);
  if (h % 2 == 0 && (fits(w, h / 2) || fits(w, h))) out.push_back(StereoLayout::kInterlaced);
  return out;
}

/// Similarity of the parts as two views of one scene.
double similarity(const ColourImage& image, StereoLayout layout) {
  const StereoPair views = parts(image, {layout, false, false});
  const ViewSimilarity found = viewSimilarity(views.left, views.right);
  const bool is_one_view = found.unshifted > kSameView || found.best <= found.unshifted;
  if (layout == StereoLayout::kInterlaced && is_one_view) return 0;
  return found.best;
}

StereoLayout mostSimilar(const ColourImage& image, const std::vector<StereoLayout>& layouts,
                         const std::string& name) {
  std::optional<StereoLayout> best;
  double best_similarity = kLeastSimilarity;
  for (const StereoLayout layout : layouts) {
    const double found = similarity(image, layout);
    if (found <= best_similarity) continue;
    best = layout;
    best_similarity = found;
  }
  if (best) return *best;
  throw InputError(say(
      name, ": ambiguous arrangement of two views in the ", image.width_px, " x ", image.height_px,
      " pixels. Give sequence.layout: side-by-side, top-bottom or ", "interlaced; crop black ",
      "borders and gaps; if this is one view, give the right one as well."));
}

/// Of an image with the size of one view, in which interlaced rows were the only layout.
[[noreturn]] void refuseOneView(const ColourImage& image, const std::string& name) {
  std::string squeezed;
  for (const StereoLayout layout : {StereoLayout::kSideBySide, StereoLayout::kTopBottom})
    if (canPart(image, layout) && similarity(image, layout) > kLeastSimilarity)
      squeezed =
          say(" Its halves look alike: if it is ", nameOf(layout), " with views of half the ",
              layout == StereoLayout::kSideBySide ? "width" : "height",
              ", enlarge them to the calibration's size first.");
  throw InputError(
      say(name, ": one view of ", image.width_px, " x ", image.height_px, " pixels is ",
          "there, the size of the calibration; the right image is missing. Give it as ", "well.",
          squeezed, " If rows of two views alternate in it, ",
          "sequence.layout=interlaced states it."));
}

StereoLayout findLayout(const ColourImage& image, const ExpectedView& view,
                        const std::string& name) {
  const std::vector<StereoLayout> layouts = candidates(image, view);
  if (layouts.empty() && view.width_px > 0)
    throw InputError(say(name, ": ", image.width_px, " x ", image.height_px, " pixels hold no two ",
                         "views of the calibration's ", view.width_px, " x ", view.height_px,
                         ". Give the calibration made for this size; if black borders or a gap ",
                         "surround the views, crop them."));
  const bool one_layout = layouts.size() == 1 && view.width_px > 0;
  if (one_layout && layouts.front() == StereoLayout::kInterlaced &&
      similarity(image, StereoLayout::kInterlaced) <= kLeastSimilarity)
    refuseOneView(image, name);
  if (one_layout) return layouts.front();
  return mostSimilar(image, layouts, name);
}

}  // namespace

StereoPair unpack(const ColourImage& packed, const StereoPacking& packing,
                  const std::string& name) {
  if (!canPart(packed, packing.layout))
    throw InputError(say(name, ": ", packed.width_px, " x ", packed.height_px,
                         " pixels can't be halved, as ", nameOf(packing.layout),
                         " needs. Is the layout right?"));
  StereoPair out = parts(packed, packing);
  if (packing.right_first) std::swap(out.left, out.right);
  return out;
}

StereoPacking choosePacking(const ColourImage& packed, const std::string& layout, bool right_first,
                            const ExpectedView& view, const std::string& name) {
  const std::optional<StereoLayout> given = layoutNamed(layout);
  StereoPacking out;
  out.layout = given ? *given : findLayout(packed, view, name);
  out.right_first = right_first;
  out.full_height = out.layout == StereoLayout::kInterlaced && view.height_px == packed.height_px;
  return out;
}

}  // namespace softscope
