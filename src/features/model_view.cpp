#include "features/model_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "features/gap_filling.h"
#include "features/kernels.h"

namespace softscope {
namespace {

constexpr int kBandRows = 32;
constexpr int kChunkPoints = 8192;
constexpr float kSmallestCosine = 0.25f;  // discs seen more obliquely are drawn at this angle
constexpr float kNearestMm = 1.0f;

/// The discs of one chunk of points, band by band; a disc is in every band that it touches.
using ChunkDiscs = std::vector<std::vector<SplatDisc>>;

/// Where the camera is, in floats.
struct Projector {
  Projector(const PinholeCamera& camera, const Eigen::Isometry3d& world_from_left,
            const ModelViewOptions& options)
      : rotation(world_from_left.linear().transpose().cast<float>()),
        translation_mm(
            (-world_from_left.linear().transpose() * world_from_left.translation()).cast<float>()),
        width(static_cast<float>(camera.width_px)),
        height(static_cast<float>(camera.height_px)),
        fx(static_cast<float>(camera.fx_px)),
        fy(static_cast<float>(camera.fy_px)),
        cx(static_cast<float>(camera.cx_px)),
        cy(static_cast<float>(camera.cy_px)),
        radius_mm(static_cast<float>(options.kDiscSpacings * options.point_spacing_mm)),
        min_radius_px(static_cast<float>(options.kMinDiscPx)) {}

  /// False where the point can't be seen.
  bool discOf(const PointModel& model, std::size_t i, SplatDisc* disc) const {
    const Eigen::Vector3f p = rotation * model.positions_mm[i] + translation_mm;
    if (!(p.z() > kNearestMm) || !p.allFinite()) return false;
    disc->inverse_depth = 1 / p.z();
    disc->u_px = fx * p.x() * disc->inverse_depth + cx;
    disc->v_px = fy * p.y() * disc->inverse_depth + cy;
    disc->radius_px = std::clamp(radius_mm * fx * disc->inverse_depth, min_radius_px,
                                 static_cast<float>(kLargestDiscPx));
    const float r = disc->radius_px;
    if (!(disc->u_px > -r && disc->u_px < width - 1 + r && disc->v_px > -r &&
          disc->v_px < height - 1 + r))
      return false;
    const Rgb8 colour = model.colours[i];
    disc->red = colour.red;
    disc->green = colour.green;
    disc->blue = colour.blue;
    disc->anchor = model.anchors[i];
    disc->point = static_cast<std::int32_t>(i);
    return tilt(rotation * model.normals[i], p, disc);
  }

 private:
  /// The plane n . x = n . p has inverse depth n . ray / n . p.
  bool tilt(const Eigen::Vector3f& normal, const Eigen::Vector3f& p, SplatDisc* disc) const {
    disc->slope_u = disc->slope_v = 0;
    const float length = normal.norm();
    if (!(length > 0.5f)) return true;  // no normal: faces the camera
    const float cosine = -normal.dot(p) / (length * p.norm());
    if (!(cosine > 0)) return false;
    const float along = -std::max(cosine, kSmallestCosine) * length * p.norm();
    disc->slope_u = normal.x() / (fx * along);
    disc->slope_v = normal.y() / (fy * along);
    return true;
  }

  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation_mm;
  float width, height, fx, fy, cx, cy, radius_mm, min_radius_px;
};

ChunkDiscs discsOfChunk(const PointModel& model, const Projector& projector, int chunk, int bands) {
  ChunkDiscs discs(static_cast<std::size_t>(bands));
  const std::size_t begin = static_cast<std::size_t>(chunk) * kChunkPoints;
  const std::size_t end = std::min(model.size(), begin + kChunkPoints);
  SplatDisc disc;
  for (std::size_t i = begin; i < end; ++i) {
    if (!projector.discOf(model, i, &disc)) continue;
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

/// Mean looks of the discs at a pixel (red, green, blue, anchor), and how far the pixel lies from
/// the mean of their centres, which is where these looks belong.
struct BlendedPixel {
  Eigen::Vector4f looks = Eigen::Vector4f::Zero();
  Eigen::Vector2f shift_px = Eigen::Vector2f::Zero();
};

void developRow(const SplatBand& band, int v, Raster<BlendedPixel>* blended, ModelView* view) {
  const std::size_t at = static_cast<std::size_t>(v - band.first_row) * band.stride;
  for (int u = 0; u < view->depth_mm.width_px; ++u) {
    const std::size_t k = at + static_cast<std::size_t>(u);
    if (!(band.weight[k] > 0)) continue;
    const float inverse_weight = 1 / band.weight[k];
    blended->at(u, v).looks =
        inverse_weight * Eigen::Vector4f(band.red[k], band.green[k], band.blue[k], band.anchor[k]);
    blended->at(u, v).shift_px = inverse_weight * Eigen::Vector2f(band.shift_u[k], band.shift_v[k]);
    view->depth_mm.at(u, v) = band.weight[k] / band.inverse_depth[k];
    view->point_index.at(u, v) = band.point[k];
  }
}

/// Change of looks per pixel from the pixel `step` before to the one `step` after; zero where
/// one of them belongs to another surface.
Eigen::Vector4f looksSlope(const Raster<BlendedPixel>& blended, const Raster<float>& depth_mm,
                           std::size_t at, std::size_t step, float surface_depth_mm) {
  const float before = depth_mm.values[at - step], after = depth_mm.values[at + step];
  if (!(std::abs(before - after) < 2 * surface_depth_mm)) return Eigen::Vector4f::Zero();
  return 0.5f * (blended.values[at + step].looks - blended.values[at - step].looks);
}

/// Moves each pixel's looks from where they belong to the pixel, along their slope.
void straightenRow(const Raster<BlendedPixel>& blended, int v, float surface_depth_mm,
                   ModelView* view) {
  const int width = blended.width_px;
  for (int u = 0; u < width; ++u) {
    const BlendedPixel& pixel = blended.at(u, v);
    Eigen::Vector4f looks = pixel.looks;
    if (u > 0 && v > 0 && u + 1 < width && v + 1 < blended.height_px) {
      const std::size_t at = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      looks += pixel.shift_px.x() * looksSlope(blended, view->depth_mm, at, 1, surface_depth_mm);
      looks += pixel.shift_px.y() * looksSlope(blended, view->depth_mm, at,
                                               static_cast<std::size_t>(width), surface_depth_mm);
    }
    const auto byte = [](float value) {
      return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
    };
    view->colour.at(u, v) = {byte(looks[0]), byte(looks[1]), byte(looks[2])};
    view->anchor.at(u, v) = byte(looks[3]);
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
  const Projector projector(camera, world_from_left, options);
  std::vector<ChunkDiscs> chunks(static_cast<std::size_t>(chunk_count));
  parallelRanges(chunk_count, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c)
      chunks[static_cast<std::size_t>(c)] = discsOfChunk(model, projector, c, bands);
  });
  Raster<BlendedPixel> blended(camera.width_px, camera.height_px);
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
