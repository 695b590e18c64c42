#include "io/geometry/xyz_files.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/not_measured.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/images/image_codec.h"
#include "io/text/message.h"

namespace softscope {

PointRaster parsePointRaster(std::string_view bytes, const std::string& name) {
  const cv::Mat image = decodeImage(bytes, name, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_32FC3)
    throw InputError(say(name, ": has ", image.channels(), " channel(s) of ", 8 * image.elemSize1(),
                         " bits, but three of 32-bit floats (x, y, z in mm) are expected."));
  PointRaster points(image.cols, image.rows, Eigen::Vector3f::Constant(kNotMeasured<float>));
  for (int v = 0; v < image.rows; ++v) {
    const auto* row = image.ptr<cv::Vec3f>(v);
    for (int u = 0; u < image.cols; ++u) {
      // OpenCV's channels run from the last to the first of the file.
      const Eigen::Vector3f p(row[u][2], row[u][1], row[u][0]);
      if (p.allFinite() && p.z() > 0) points.at(u, v) = p;
    }
  }
  return points;
}

PointRaster readPointRaster(const std::filesystem::path& file) {
  return parsePointRaster(readBytes(file), shown(file));
}

void writePointRaster(const std::filesystem::path& file, const PointRaster& points,
                      bool overwrite) {
  requireWritable(file, overwrite);
  cv::Mat image(points.height_px, points.width_px, CV_32FC3);
  for (int v = 0; v < points.height_px; ++v)
    for (int u = 0; u < points.width_px; ++u) {
      const Eigen::Vector3f& p = points.at(u, v);
      image.at<cv::Vec3f>(v, u) = {p.z(), p.y(), p.x()};
    }
  // OpenCV's default for three floats, SGILOG, loses digits.
  constexpr int kNoCompression = 1;
  writeFile(file, encodeImage(".tif", image, {cv::IMWRITE_TIFF_COMPRESSION, kNoCompression}),
            overwrite);
}

Raster<float> rectifiedDepth(const PointRaster& points, const RectifiedRig& rig) {
  Raster<float> depth_mm(rig.left.width_px, rig.left.height_px, kNotMeasured<float>);
  for (const Eigen::Vector3f& raw : points.values) {
    if (!raw.allFinite()) continue;
    const Eigen::Vector3d p = rig.rectified_from_raw_left * raw.cast<double>();
    if (!(p.z() > 0)) continue;
    const Eigen::Vector2d pixel = projectPoint(rig.left, p);
    if (!(pixel.cwiseAbs().maxCoeff() < 1e6)) continue;
    const int u = static_cast<int>(std::lround(pixel.x())),
              v = static_cast<int>(std::lround(pixel.y()));
    if (!depth_mm.contains(u, v)) continue;
    float& nearest_mm = depth_mm.at(u, v);
    const float z_mm = static_cast<float>(p.z());
    if (!(nearest_mm <= z_mm)) nearest_mm = z_mm;
  }
  return depth_mm;
}

}  // namespace softscope
