#include "features/model_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "features/gap_filling.h"
#include "features/kernels.h"
#include "features/view_projector.h"

namespace softscope {
namespace {

constexpr int kBandRows = 32;
constexpr int kChunkPoints = 8192;

/// Discs of one chunk of points, by band; a disc is in every band that it overlaps.
using ChunkDiscs = std::vector<std::vector<SplatDisc>>;

ViewVector viewVector(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

/// False for an invisible point.
bool discOf(const ViewProjector& projector, const PointModel& model, std::size_t i,
            SplatDisc* disc) {
  if (!placeDisc(projector, viewVector(model.positions_mm[i]), viewVector(model.normals[i]), disc))
    return false;
  const Rgb8 colour = model.colours[i];
  disc->red = colour.red;
  disc->green = colour.green;
  disc->blue = colour.blue;
  disc->anchor = model.anchors[i];
  disc->point = static_cast<std::int32_t>(i);
  return true;
}

ChunkDiscs discsOfChunk(const PointModel& model, const ViewProjector& projector, int chunk,
                        int bands) {
  ChunkDiscs discs(static_cast<std::size_t>(bands));
  const std::size_t begin = static_cast<std::size_t>(chunk) * kChunkPoints;
  const std::size_t end = std::min(model.size(), begin + kChunkPoints);
  SplatDisc disc;
  for (std::size_t i = begin; i < end; ++i) {
    if (!discOf(projector, model, i, &disc)) continue;
    const int top = static_cast<int>(std::floor(disc.v_px - disc.radius_px)) / kBandRows;
    const int bottom = static_cast<int>(std::ceil(disc.v_px + disc.radius_px)) / kBandRows;
    for (int band = std::max(top, 0); band <= std::min(bottom, bands - 1); ++band)
      discs[static_cast<std::size_t>(band)].push_back(disc);
  }
  return discs;
}

/// The sums of one band of rows.
class BandCanvas {
 public:
  BandCanvas(int width, float tolerance_mm)
      : stride_(width + 2 * kSplatMargin),
        sums_(static_cast<std::size_t>(stride_) * kBandRows * kPlanes),
        points_(static_cast<std::size_t>(stride_) * kBandRows),
        tolerance_mm_(tolerance_mm) {}

  SplatBand clear(int first_row, int rows) {
    std::fill(sums_.begin(), sums_.end(), 0.0f);
    std::fill(points_.begin(), points_.end(), -1);
    const auto plane = [&](int k) {
      return sums_.data() + static_cast<std::size_t>(k) * kBandRows * stride_ + kSplatMargin;
    };
    return {plane(0),
            plane(1),
            plane(2),
            plane(3),
            plane(4),
            plane(5),
            plane(6),
            plane(7),
            plane(8),
            plane(9),
            points_.data() + kSplatMargin,
            stride_,
            first_row,
            rows,
            tolerance_mm_};
  }

 private:
  static constexpr std::size_t kPlanes = 10;
  int stride_;
  std::vector<float> sums_;
  std::vector<std::int32_t> points_;
  float tolerance_mm_;
};

void developRow(const SplatBand& band, int v, Raster<BlendedPixel>* blended, ModelView* view) {
  const std::size_t at = static_cast<std::size_t>(v - band.first_row) * band.stride;
  for (int u = 0; u < view->depth_mm.width_px; ++u) {
    const std::size_t k = at + static_cast<std::size_t>(u);
    if (!(band.weight[k] > 0)) continue;
    const float inverse_weight = 1 / band.weight[k];
    blended->at(u, v) = {{inverse_weight * band.red[k], inverse_weight * band.green[k],
                          inverse_weight * band.blue[k], inverse_weight * band.anchor[k]},
                         inverse_weight * band.shift_u[k],
                         inverse_weight * band.shift_v[k]};
    view->depth_mm.at(u, v) = band.weight[k] / band.inverse_depth[k];
    view->point_index.at(u, v) = band.point[k];
  }
}

/// Shifts colours along their slope from the pixel `step` before to the
/// one `step` after; unchanged if one of these belongs to another surface.
void straighten(const Raster<BlendedPixel>& blended, const Raster<float>& depth_mm, std::size_t at,
                std::size_t step, float shift_px, float surface_depth_mm, float (&looks)[kLooks]) {
  if (!isOneSurface(depth_mm.values[at - step], depth_mm.values[at + step], surface_depth_mm))
    return;
  for (int k = 0; k < kLooks; ++k)
    looks[k] = movedLooks(looks[k], shift_px, blended.values[at - step].looks[k],
                          blended.values[at + step].looks[k]);
}

/// Shifts the colours of each pixel from their mean position to the pixel centre.
void straightenRow(const Raster<BlendedPixel>& blended, int v, float surface_depth_mm,
                   ModelView* view) {
  const int width = blended.width_px;
  for (int u = 0; u < width; ++u) {
    BlendedPixel pixel = blended.at(u, v);
    if (u > 0 && v > 0 && u + 1 < width && v + 1 < blended.height_px) {
      const std::size_t at = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      straighten(blended, view->depth_mm, at, 1, pixel.shift_u, surface_depth_mm, pixel.looks);
      straighten(blended, view->depth_mm, at, static_cast<std::size_t>(width), pixel.shift_v,
                 surface_depth_mm, pixel.looks);
    }
    view->colour.at(u, v) = {looksByte(pixel.looks[0]), looksByte(pixel.looks[1]),
                             looksByte(pixel.looks[2])};
    view->anchor.at(u, v) = looksByte(pixel.looks[3]);
  }
}

void drawBand(const std::vector<ChunkDiscs>& chunks, int index, BandCanvas* canvas,
              Raster<BlendedPixel>* blended, ModelView* view) {
  const FeatureKernels& kernels = featureKernels();
  const int first_row = index * kBandRows;
  const int rows = std::min(kBandRows, view->depth_mm.height_px - first_row);
  const SplatBand band = canvas->clear(first_row, rows);
  const auto forEachChunk = [&](auto kernel) {
    for (const ChunkDiscs& chunk : chunks) {
      const auto& discs = chunk[static_cast<std::size_t>(index)];
      kernel(discs.data(), static_cast<int>(discs.size()), band);
    }
  };
  forEachChunk(kernels.splatFront);
  forEachChunk(kernels.splatBlend);
  for (int v = first_row; v < first_row + rows; ++v) developRow(band, v, blended, view);
}

}  // namespace

ModelView renderModelView(const PointModel& model, const PinholeCamera& camera,
                          const Eigen::Isometry3d& world_from_left,
                          const ModelViewOptions& options) {
  ModelView view;
  view.camera = camera;
  view.world_from_left = world_from_left;
  view.colour = ColourImage(camera.width_px, camera.height_px);
  view.anchor = GrayImage(camera.width_px, camera.height_px);
  view.depth_mm =
      Raster<float>(camera.width_px, camera.height_px, std::numeric_limits<float>::quiet_NaN());
  view.point_index = Raster<std::int32_t>(camera.width_px, camera.height_px, -1);

  const int bands = (camera.height_px + kBandRows - 1) / kBandRows;
  const int chunk_count = static_cast<int>((model.size() + kChunkPoints - 1) / kChunkPoints);
  const ViewProjector projector = viewProjector(camera, world_from_left, options);
  std::vector<ChunkDiscs> chunks(static_cast<std::size_t>(chunk_count));
  parallelRanges(chunk_count, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c)
      chunks[static_cast<std::size_t>(c)] = discsOfChunk(model, projector, c, bands);
  });
  Raster<BlendedPixel> blended(camera.width_px, camera.height_px, BlendedPixel{});
  const float surface_depth_mm = static_cast<float>(options.kSurfaceDepthMm);
  parallelRanges(bands, 1, [&](int begin, int end) {
    BandCanvas canvas(camera.width_px, surface_depth_mm);
    for (int b = begin; b < end; ++b) drawBand(chunks, b, &canvas, &blended, &view);
  });
  parallelRows(camera.height_px,
               [&](int v) { straightenRow(blended, v, surface_depth_mm, &view); });
  fillGaps(options.gap_px, surface_depth_mm, &view);
  return view;
}

}  // namespace softscope
