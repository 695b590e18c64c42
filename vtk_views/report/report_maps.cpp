// vtk_views/report/report_maps.cpp: quantisation to 16 bits, little-endian as in browsers.
#include "vtk_views/report/report_maps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "core/error.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/drawing/html_text.h"
#include "vtk_views/scenes/map_view.h"

namespace softscope {
namespace {

constexpr std::uint16_t kNoError = 65535;
constexpr double kLargestSteps = 65000;
constexpr int kPalette = 256;

std::string jsonNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", std::isfinite(value) ? value : 0.0);
  return text;
}

std::string vectorJson(const Eigen::Vector3f& v) {
  return "[" + jsonNumber(v.x()) + "," + jsonNumber(v.y()) + "," + jsonNumber(v.z()) + "]";
}

template <class Unsigned>
void append(Unsigned value, std::string& bytes) {
  for (std::size_t k = 0; k < sizeof(Unsigned); ++k)
    bytes += static_cast<char>(value >> (8 * k) & 0xFF);
}

/// Common data of all frames of a case.
struct Scale {
  Eigen::AlignedBox3f box;
  double step_mm = 1e-6;  // of errors

  explicit Scale(const std::vector<ErrorMap>& moments) {
    double largest_mm = 0;
    for (const ErrorMap& map : moments) {
      for (const auto* mesh : {&map.surface, &map.reference})
        for (const Eigen::Vector3f& p : mesh->vertices_mm) box.extend(p);
      for (const float e : map.absolute_mm)
        if (std::isfinite(e)) largest_mm = std::max(largest_mm, double(e));
    }
    step_mm = std::max(largest_mm / kLargestSteps, 1e-6);
  }
};

std::string placesOf(const TriangleMesh& mesh, const Scale& scale) {
  const Eigen::Array3f size = scale.box.sizes().array().max(1e-6f);
  std::string bytes;
  for (const Eigen::Vector3f& p : mesh.vertices_mm) {
    const Eigen::Array3f part = ((p - scale.box.min()).array() / size).max(0.f).min(1.f);
    for (int k = 0; k < 3; ++k)
      append(static_cast<std::uint16_t>(std::lround(65535 * part[k])), bytes);
  }
  return jsonQuoted(base64(bytes));
}

std::string errorsOf(const ErrorMap& map, const Scale& scale) {
  std::string bytes;
  for (const float e : map.absolute_mm)
    append(std::isfinite(e) ? static_cast<std::uint16_t>(std::lround(e / scale.step_mm)) : kNoError,
           bytes);
  return jsonQuoted(base64(bytes));
}

std::string flagsOf(const ErrorMap& map) {
  std::string bytes;
  for (std::size_t i = 0; i < map.signed_mm.size(); ++i) {
    const bool observed = map.observed.empty() || map.observed[i] != 0;
    bytes += static_cast<char>((observed ? 1 : 0) | (map.signed_mm[i] < 0 ? 2 : 0) |
                               (std::isfinite(map.signed_mm[i]) ? 0 : 4));
  }
  return jsonQuoted(base64(bytes));
}

std::string trianglesOf(const TriangleMesh& mesh) {
  std::string bytes;
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t corner : t) append(static_cast<std::uint32_t>(corner), bytes);
  return jsonQuoted(base64(bytes));
}

std::string labelOf(const ErrorMap& map) {
  if (map.frame < 0) return "";
  char time[32] = "";
  if (std::isfinite(map.time_s)) std::snprintf(time, sizeof time, ", %.2f s", map.time_s);
  return "frame " + std::to_string(map.frame) + time;
}

/// The triangles of the reference are omitted if equal to those of the first frame.
std::string momentJson(const ErrorMap& map, const ErrorMap& first, const Scale& scale) {
  std::string json = "{\"label\":" + jsonQuoted(labelOf(map)) +
                     ",\"places\":" + placesOf(map.surface, scale) +
                     ",\"errors\":" + errorsOf(map, scale) + ",\"flags\":" + flagsOf(map);
  if (!map.surface.empty()) json += ",\"triangles\":" + trianglesOf(map.surface);
  if (!map.reference.empty()) {
    json += ",\"reference\":{\"places\":" + placesOf(map.reference, scale);
    if (&map == &first || map.reference.triangles != first.reference.triangles)
      json += ",\"triangles\":" + trianglesOf(map.reference);
    json += "}";
  }
  return json + "}";
}

std::string mapJson(const ReportMap& map) {
  if (map.moments.empty()) throw Error("report: a case without a map");
  const ErrorMap& first = map.moments.front();
  const Scale scale(map.moments);
  double spacing_mm = 0;
  bool observed = false;
  std::vector<const ErrorMap*> moments;
  for (const ErrorMap& moment : map.moments) {
    moments.push_back(&moment);
    spacing_mm = std::max(spacing_mm, pointSpacingMm(moment));
    observed = observed || !moment.observed.empty();
  }
  const Eigen::AlignedBox3f seen = mostOfPoints(first, moments);  // right, up, towards the viewer
  const Eigen::Vector3f half = (seen.sizes() / 2).cwiseMax(1e-3f);
  const double depth_mm = std::max(double(scale.box.diagonal().norm()), 1e-3);
  std::string json =
      "{\"name\":" + jsonQuoted(map.name) + ",\"low_mm\":" + vectorJson(scale.box.min()) +
      ",\"size_mm\":" + vectorJson(scale.box.sizes()) +
      ",\"step_mm\":" + jsonNumber(scale.step_mm) + ",\"look\":" + vectorJson(first.look) +
      ",\"up\":" + vectorJson(first.up) +
      ",\"centre_mm\":" + vectorJson(viewAxes(first) * seen.center()) + ",\"half_mm\":[" +
      jsonNumber(half.x()) + "," + jsonNumber(half.y()) + "],\"depth_mm\":" + jsonNumber(depth_mm) +
      ",\"point_mm\":" + jsonNumber(2 * spacing_mm) +
      ",\"push_mm\":" + jsonNumber(0.02 * depth_mm) + ",\"space\":" +
      jsonQuoted(first.surface.space.empty() ? "the reference's frame" : first.surface.space) +
      ",\"has_observed\":" + (observed ? "true" : "false") + ",\"moments\":[";
  for (const ErrorMap& moment : map.moments)
    json += (&moment == &first ? "" : ",\n") + momentJson(moment, first, scale);
  return json + "]}";
}

std::string paletteJson(bool is_signed) {
  std::string bytes;
  for (int i = 0; i < kPalette; ++i) {
    const double part = double(i) / (kPalette - 1);
    const Rgb8 c = is_signed ? blueWhiteRed(2 * part - 1) : viridis(part);
    bytes += {static_cast<char>(c.red), static_cast<char>(c.green), static_cast<char>(c.blue)};
  }
  return jsonQuoted(base64(bytes));
}

double largestErrorMm(const std::vector<ReportMap>& maps) {
  double largest_mm = 1e-3;
  for (const ReportMap& map : maps)
    for (const ErrorMap& moment : map.moments)
      for (const float e : moment.absolute_mm)
        if (std::isfinite(e)) largest_mm = std::max(largest_mm, double(e));
  return largest_mm;
}

}  // namespace

std::string reportMapsJson(const std::vector<ReportMap>& maps, double limit_mm) {
  std::string json = "{\"limit_mm\":" + jsonNumber(limit_mm) +
                     ",\"largest_mm\":" + jsonNumber(std::max(largestErrorMm(maps), limit_mm)) +
                     ",\"palettes\":{\"unsigned\":" + paletteJson(false) +
                     ",\"signed\":" + paletteJson(true) + "},\"maps\":[";
  for (const ReportMap& map : maps) json += (&map == &maps.front() ? "" : ",\n") + mapJson(map);
  return json + "]}";
}

}  // namespace softscope
