#include "io/geometry/depth_files.h"

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/not_measured.h"
#include "io/documents/npy_file.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/geometry/pfm_file.h"
#include "io/images/image_codec.h"
#include "io/images/image_writer.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
constexpr double kMostSteps = 65535;

Raster<float> fromSteps(const cv::Mat& steps, double unit) {
  Raster<float> out(steps.cols, steps.rows, kNotMeasured<float>);
  for (int v = 0; v < steps.rows; ++v) {
    const auto* row = steps.ptr<std::uint16_t>(v);
    for (int u = 0; u < steps.cols; ++u)
      if (row[u] != 0) out.at(u, v) = static_cast<float>(row[u] * unit);
  }
  return out;
}

Raster<float> fromFloats(const cv::Mat& floats) {
  Raster<float> out(floats.cols, floats.rows, kNotMeasured<float>);
  for (int v = 0; v < floats.rows; ++v) {
    const auto* row = floats.ptr<float>(v);
    for (int u = 0; u < floats.cols; ++u)
      if (std::isfinite(row[u])) out.at(u, v) = row[u];
  }
  return out;
}

/// Either format; a step of a 16-bit file is `unit`.
Raster<float> parseMap(std::string_view bytes, const std::string& name, double unit) {
  if (bytes.substr(0, 2) == "Pf" || bytes.substr(0, 2) == "PF") return parsePfm(bytes, name);
  const cv::Mat image = decodeImage(bytes, name, cv::IMREAD_UNCHANGED);
  if (image.type() == CV_16U) return fromSteps(image, unit);
  if (image.type() == CV_32F) return fromFloats(image);
  throw InputError(say(name, ": has ", image.channels(), " channel(s) of ", 8 * image.elemSize1(),
                       " bits, but one of 16 bits, or of 32-bit floats, is expected."));
}

Raster<std::uint16_t> toSteps(const Raster<float>& values, double unit) {
  Raster<std::uint16_t> out(values.width_px, values.height_px, 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double steps = std::round(values.values[i] / unit);
    if (steps >= 1 && steps <= kMostSteps) out.values[i] = static_cast<std::uint16_t>(steps);
  }
  return out;
}

Raster<float> fromMetres(const NpyArray& metres) {
  Raster<float> depth_mm(static_cast<int>(metres.columns), static_cast<int>(metres.rows),
                         kNotMeasured<float>);
  for (std::size_t i = 0; i < depth_mm.size(); ++i)
    depth_mm.values[i] = static_cast<float>(1000 * metres.values[i]);
  return depth_mm;
}

}  // namespace

Raster<float> parseDepth(std::string_view bytes, const std::string& name, double unit_mm) {
  Raster<float> depth_mm =
      isNpy(bytes) ? fromMetres(parseNpy(bytes, name)) : parseMap(bytes, name, unit_mm);
  for (float& value : depth_mm.values)
    if (!(value > 0 && std::isfinite(value))) value = kNotMeasured<float>;
  return depth_mm;
}

Raster<float> parseDisparity(std::string_view bytes, const std::string& name) {
  return parseMap(bytes, name, kDisparityStepPx);
}

Raster<float> readDepth(const fs::path& file, double unit_mm) {
  return parseDepth(readBytes(file), shown(file), unit_mm);
}
Raster<float> readDisparity(const fs::path& file) {
  return parseDisparity(readBytes(file), shown(file));
}

void writeDepthPng(const fs::path& file, const Raster<float>& depth_mm, double unit_mm,
                   bool overwrite) {
  require(unit_mm > 0, "depth_unit_mm", unit_mm, "must be above 0");
  writePng(file, toSteps(depth_mm, unit_mm), overwrite);
}
void writeDepthTiff(const fs::path& file, const Raster<float>& depth_mm, double unit_mm,
                    bool overwrite) {
  require(unit_mm > 0, "depth_unit_mm", unit_mm, "must be above 0");
  requireWritable(file, overwrite);
  writeFile(file, encodeImage(".tif", matrixView(toSteps(depth_mm, unit_mm), CV_16U)), overwrite);
}
void writeDisparityPng(const fs::path& file, const Raster<float>& disparity_px, bool overwrite) {
  writePng(file, toSteps(disparity_px, kDisparityStepPx), overwrite);
}
void writePfm(const fs::path& file, const Raster<float>& raster, bool overwrite) {
  requireWritable(file, overwrite);
  writeFile(file, pfmBytes(raster), overwrite);
}
void writeDepthNpy(const fs::path& file, const Raster<float>& depth_mm, bool overwrite) {
  requireWritable(file, overwrite);
  Raster<float> metres = depth_mm;
  for (float& value : metres.values) value /= 1000;
  writeFile(file, npyBytes(metres), overwrite);
}

}  // namespace softscope
