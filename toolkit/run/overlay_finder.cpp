#include "toolkit/run/overlay_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/background_work.h"
#include "core/mask_morphology.h"
#include "core/parallel.h"
#include "io/text/message.h"
#include "stereo/rectification/image_border.h"

namespace softscope {
namespace {

constexpr int kCellPx = 40;
constexpr double kLeastMotionPx = 5;  // between two images: more than a blurred edge is wide
constexpr int kFewestImages = 8;
constexpr float kLeastEdge = 8;         // grey levels per pixel: what matching finds in noise
constexpr float kLeastRatio = 1;        // of the gradient to the standard deviation, per pixel
constexpr double kBesideShare = 0.005;  // of the width: compression blurs edges
constexpr double kHarmlessShare = 0.002;

int radiusPx(int width_px) {
  return std::max(2, static_cast<int>(std::lround(kBesideShare * width_px)));
}

int cellsAlong(int size_px) { return (size_px + kCellPx - 1) / kCellPx; }

std::size_t cellOf(int u, int v, int columns) {
  return static_cast<std::size_t>(v / kCellPx * columns + u / kCellPx);
}

/// How far the tissue in the middle of a cell has moved in the image. Infinite where it has left.
double motionPx(const PinholeCamera& camera, const Eigen::Isometry3d& now_from_then,
                const Eigen::Vector2d& pixel, double depth_mm) {
  const Eigen::Vector3d there = now_from_then * liftPixel(camera, pixel.x(), pixel.y(), depth_mm);
  if (!(there.z() > 0)) return std::numeric_limits<double>::infinity();
  return (projectPoint(camera, there) - pixel).norm();
}

}  // namespace

OverlayFinder::Pixels::Pixels(const ColourImage& first)
    : mean(first.width_px, first.height_px, 0),
      squares(first.width_px, first.height_px, 0),
      ignored(first.width_px, first.height_px, 0) {
  ignore(findBorder(first));
}

void OverlayFinder::Pixels::ignore(const Mask& mask) {
  if (mask.values.size() != ignored.values.size()) return;
  for (std::size_t i = 0; i < ignored.values.size(); ++i)
    ignored.values[i] |= static_cast<std::uint8_t>(mask.values[i] != 0);
}

/// `images_of_cells`: 0 for cells that have not moved.
void OverlayFinder::Pixels::add(const Frame& frame, const std::vector<int>& images_of_cells) {
  const ColourImage& left = frame.pair.left;
  const int columns = cellsAlong(left.width_px);
  ignore(frame.mask);
  parallelRows(left.height_px, [&](int v) {
    for (int u = 0; u < left.width_px; ++u) {
      const int images = images_of_cells[cellOf(u, v, columns)];
      if (images == 0) continue;
      const float level = toGray(left.at(u, v)), off = level - mean.at(u, v);
      mean.at(u, v) += off / static_cast<float>(images);
      squares.at(u, v) += off * (level - mean.at(u, v));
    }
  });
}

/// True if cells have moved: then with the number of their images.
bool OverlayFinder::takePose(const PinholeCamera& camera, const Eigen::Isometry3d& world_from_left,
                             double depth_mm, std::vector<int>* images_of_cells) {
  const int columns = cellsAlong(pixels_->mean.width_px);
  images_of_cells->assign(cells_.size(), 0);
  bool any = false;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    const int column = static_cast<int>(c) % columns, row = static_cast<int>(c) / columns;
    const Eigen::Vector2d middle((column + 0.5) * kCellPx, (row + 0.5) * kCellPx);
    if (cell.images > 0 && !(motionPx(camera, world_from_left.inverse() * cell.world_from_left,
                                      middle, cell.depth_mm) >= kLeastMotionPx))
      continue;
    cell = {world_from_left, depth_mm, cell.images + 1};
    (*images_of_cells)[c] = cell.images;
    any = true;
  }
  return any;
}

void OverlayFinder::add(std::shared_ptr<const Frame> frame, const PinholeCamera& camera,
                        const Eigen::Isometry3d& world_from_left, double depth_mm) {
  const ColourImage& left = frame->pair.left;
  if (left.empty() || !(depth_mm > 0)) return;
  if (!pixels_) {
    pixels_ = std::make_shared<Pixels>(left);
    cells_.resize(static_cast<std::size_t>(cellsAlong(left.width_px) * cellsAlong(left.height_px)));
  }
  if (left.width_px != pixels_->mean.width_px || left.height_px != pixels_->mean.height_px) return;
  std::vector<int> images_of_cells;
  if (!takePose(camera, world_from_left, depth_mm, &images_of_cells)) return;
  if (pending_.valid()) pending_.get();
  pending_ = std::async(threadCount() > 1 ? std::launch::async : std::launch::deferred,
                        [pixels = pixels_, frame = std::move(frame),
                         images_of_cells = std::move(images_of_cells)] {
                          runInBackground([&] { pixels->add(*frame, images_of_cells); });
                        })
                 .share();
}

Mask OverlayFinder::found() const {
  if (!pixels_) return {};
  if (pending_.valid()) pending_.get();
  const Raster<float>& mean = pixels_->mean;
  const int radius_px = radiusPx(mean.width_px);
  const Mask ignored = dilated(pixels_->ignored, 2 * radius_px);  // their edges stand still as well
  const int columns = cellsAlong(mean.width_px);
  Mask fixed(mean.width_px, mean.height_px, 0);
  for (int v = 1; v + 1 < mean.height_px; ++v)
    for (int u = 1; u + 1 < mean.width_px; ++u) {
      const int images = cells_[cellOf(u, v, columns)].images;
      if (images < kFewestImages || ignored.at(u, v) != 0) continue;
      const float across = (mean.at(u + 1, v) - mean.at(u - 1, v)) / 2,
                  down = (mean.at(u, v + 1) - mean.at(u, v - 1)) / 2,
                  edge = std::hypot(across, down);
      const float deviation = std::sqrt(pixels_->squares.at(u, v) / static_cast<float>(images - 1));
      fixed.at(u, v) = edge >= kLeastEdge && edge >= kLeastRatio * deviation;
    }
  Mask around = eroded(dilated(fixed, 3 * radius_px), 2 * radius_px);  // fills letters
  for (std::uint8_t& pixel : around.values) pixel = pixel != 0 ? 255 : 0;
  return around;
}

std::string overlayWarning(const Mask& found, const std::string& file) {
  const auto pixels = std::count(found.values.begin(), found.values.end(), 255);
  const double share =
      found.empty() ? 0 : static_cast<double>(pixels) / static_cast<double>(found.values.size());
  if (share < kHarmlessShare) return "";
  return say(
      std::round(1000 * share) / 10,
      " % of the left image stand still while the scope moves: text or icons drawn into it, "
      "dirt on the lens, or an instrument that moves with it. They are measured as a surface "
      "at a wrong distance; ",
      file, " marks them, for --mask of another run");
}

}  // namespace softscope
