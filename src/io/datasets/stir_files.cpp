#include "io/datasets/stir_files.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/documents/document.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

using Json = nlohmann::ordered_json;

struct FrameKey {
  int frame = 0, instance = 0;
};

FrameKey keyOf(const std::string& key, const std::string& name) {
  FrameKey out;
  const char* const end = key.data() + key.size();
  const auto frame = std::from_chars(key.data(), end, out.frame);
  if (frame.ec == std::errc() && frame.ptr != end && *frame.ptr == '/') {
    const auto instance = std::from_chars(frame.ptr + 1, end, out.instance);
    if (instance.ec == std::errc() && instance.ptr == end && out.frame >= 0 && out.instance >= 0)
      return out;
  }
  throw InputError(say(name, ": the key ", excerpt(key),
                       " is no FRAME/INSTANCE, such as \"12/0\". Is it STIR 2026's file?"));
}

const Document& memberOf(const Document& entry, const char* member, const std::string& label) {
  if (const Document* found = entry.find(member)) return *found;
  throw InputError(say(label, ": ", member, " is missing, but STIR 2026's files have it."));
}

std::vector<double> finiteNumbers(const Document& entry, const char* member,
                                  const std::string& label) {
  std::vector<double> values;
  for (const Document& item : memberOf(entry, member, label).items) {
    const auto value = numberOf(item.text);
    if (!value || !std::isfinite(*value))
      throw InputError(say(label, ": ", member, " has ", excerpt(item.text), " for point ",
                           values.size(), ", but every point has a finite place in every frame."));
    values.push_back(*value);
  }
  return values;
}

std::vector<bool> flags(const Document& entry, const char* member, const std::string& label) {
  std::vector<bool> out;
  for (const Document& item : memberOf(entry, member, label).items) {
    const bool is_true = item.text == "true" || item.text == "1";
    if (!is_true && item.text != "false" && item.text != "0")
      throw InputError(say(label, ": ", member, " has ", excerpt(item.text),
                           ", but true or false is expected."));
    out.push_back(is_true);
  }
  return out;
}

void requireCount(std::size_t found, std::size_t expected, const std::string& label,
                  const char* member) {
  if (found != expected)
    throw InputError(say(label, ": ", member, " has ", found, " entries, but left_x has ", expected,
                         "; one a point is expected."));
}

std::vector<StirPoint> pointsOf(const Document& entry, const std::string& label) {
  const auto u = finiteNumbers(entry, "left_x", label), v = finiteNumbers(entry, "left_y", label),
             disparity = finiteNumbers(entry, "disparity", label);
  const auto left = flags(entry, "left_visibility", label),
             right = flags(entry, "right_visibility", label);
  requireCount(v.size(), u.size(), label, "left_y");
  requireCount(disparity.size(), u.size(), label, "disparity");
  requireCount(left.size(), u.size(), label, "left_visibility");
  requireCount(right.size(), u.size(), label, "right_visibility");
  std::vector<StirPoint> points;
  for (std::size_t i = 0; i < u.size(); ++i)
    points.push_back({u[i], v[i], disparity[i], left[i], right[i]});
  return points;
}

Document objectOf(std::string_view text, const std::string& name) {
  Document document = parseJson(text, name);
  if (document.kind != Document::Kind::kMap)
    throw InputError(name + ": holds no JSON object, but STIR 2026's files do.");
  return document;
}

Json matrixJson(const Eigen::Matrix3d& m) {
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) rows.push_back({m(r, 0), m(r, 1), m(r, 2)});
  return rows;
}

Json lensJson(const RawCamera& camera) {
  const auto& c = camera.distortion.coefficients;
  for (std::size_t i = 5; i < c.size(); ++i)
    require(c[i] == 0, "the lens", c[i],
            "STIR 2026's calib.json has five coefficients; leave the others at 0");
  return {c[0], c[1], c[2], c[3], c[4]};
}

}  // namespace

StirAnnotations parseStirAnnotations(std::string_view text, const std::string& name) {
  const Document document = objectOf(text, name);
  StirAnnotations annotations;
  std::size_t count = 0;
  for (const auto& [key, entry] : document.members) {
    const FrameKey at = keyOf(key, name);
    if (at.instance != 0) continue;
    std::vector<StirPoint> points = pointsOf(entry, say(name, ": ", key));
    if (annotations.empty()) count = points.size();
    if (points.size() != count)
      throw InputError(say(name, ": frame ", at.frame, " has ", points.size(),
                           " points, but the first one has ", count,
                           "; every point has a place in every frame."));
    annotations[at.frame] = std::move(points);
  }
  if (annotations.empty())
    throw InputError(name + ": holds no frame of instance 0, but one or more are expected.");
  return annotations;
}

StirAnnotations readStirAnnotations(const std::filesystem::path& file) {
  return parseStirAnnotations(readBytes(file), shown(file));
}

std::vector<Eigen::Vector2d> parseStirQueries(std::string_view text, const std::string& name) {
  const Document document = objectOf(text, name);
  const Document* entry = &document;
  if (!document.find("left_x"))  // as in annotations.json: frame 0, instance 0
    entry = document.find("0/0");
  if (!entry)
    throw InputError(name +
                     ": holds neither left_x nor \"0/0\", but queries of frame 0 are "
                     "expected.");
  const auto u = finiteNumbers(*entry, "left_x", name), v = finiteNumbers(*entry, "left_y", name);
  requireCount(v.size(), u.size(), name, "left_y");
  std::vector<Eigen::Vector2d> queries;
  for (std::size_t i = 0; i < u.size(); ++i) queries.emplace_back(u[i], v[i]);
  return queries;
}

std::vector<Eigen::Vector2d> readStirQueries(const std::filesystem::path& file) {
  return parseStirQueries(readBytes(file), shown(file));
}

std::string stirAnnotationsJson(const StirAnnotations& annotations) {
  Json json = Json::object();
  for (const auto& [frame, points] : annotations) {
    Json& entry = json[say(frame, "/0")];
    for (const char* key : {"left_x", "left_y", "disparity", "left_visibility", "right_visibility"})
      entry[key] = Json::array();
    for (const StirPoint& point : points) {
      entry["left_x"].push_back(point.left_u_px);
      entry["left_y"].push_back(point.left_v_px);
      entry["disparity"].push_back(point.disparity_px);
      entry["left_visibility"].push_back(point.left_visible);
      entry["right_visibility"].push_back(point.right_visible);
    }
  }
  return json.dump() + "\n";
}

std::string stirQueriesJson(const std::vector<Eigen::Vector2d>& queries_px) {
  Json u = Json::array(), v = Json::array();
  for (const Eigen::Vector2d& query : queries_px) {
    u.push_back(query.x());
    v.push_back(query.y());
  }
  return Json{{"0/0", {{"left_x", u}, {"left_y", v}}}}.dump() + "\n";
}

std::string stirCalibrationJson(const StereoCalibration& calibration) {
  const Eigen::Vector3d t_m = calibration.right_from_left.translation() / 1000;
  return Json{{"K_left", matrixJson(calibration.left.pinhole.matrix())},
              {"K_right", matrixJson(calibration.right.pinhole.matrix())},
              {"D_left", lensJson(calibration.left)},
              {"D_right", lensJson(calibration.right)},
              {"R_left_to_right", matrixJson(calibration.right_from_left.linear())},
              {"t_left_to_right", {t_m.x(), t_m.y(), t_m.z()}}}
             .dump(1) +
         "\n";
}

std::string stirPredictionsJson(
    const std::map<std::string, std::map<int, StirPrediction>>& predictions) {
  Json json = Json::object();
  for (const auto& [sequence, frames] : predictions) {
    Json& of_sequence = json[sequence] = Json::object();
    for (const auto& [frame, prediction] : frames) {
      Json coords = Json::array(), visible = Json::array();
      for (const Eigen::Vector3d& p : prediction.positions_mm)
        coords.push_back({p.x() / 1000, p.y() / 1000, p.z() / 1000});
      for (const bool one : prediction.visible) visible.push_back(one);
      of_sequence[std::to_string(frame)] = {
          {"coords", coords}, {"visibilities", visible}, {"latency_ms", prediction.latency_ms}};
    }
  }
  return json.dump() + "\n";
}

}  // namespace softscope
