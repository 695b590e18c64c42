// toolkit/evaluation/depth_map_result.cpp: evaluation of pairs of maps, and means over them.
#include "toolkit/evaluation/depth_map_result.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "io/calibrations/calibration_reader.h"
#include "io/files/folder.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/text/message.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/record/version.h"
#include "vtk_views/plots/map_error_plot.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

const std::vector<std::string_view> kMapFiles{".pfm", ".tif", ".tiff", ".png", ".npy"};

bool isMapName(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return std::find(kMapFiles.begin(), kMapFiles.end(), extension) != kMapFiles.end();
}

/// "000012" of 000012_disparity.pfm; empty for a name without leading digits.
std::string frameDigits(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.substr(0, std::min(stem.find_first_not_of("0123456789"), stem.size()));
}

/// Maps of a folder whose names contain `part`, one per number: `depth` writes PFM and PNG.
std::vector<fs::path> depthMapsIn(const fs::path& path, const std::string& part) {
  if (!isFolder(path)) return {path};
  std::vector<fs::path> named, all;
  for (const fs::path& file : filesIn(path, kMapFiles)) {
    const bool known =
        !all.empty() && !frameDigits(file).empty() && frameDigits(all.back()) == frameDigits(file);
    if (!known) all.push_back(file);
    if (file.filename().string().find(part) == std::string::npos) continue;
    if (named.empty() || frameDigits(file).empty() ||
        frameDigits(named.back()) != frameDigits(file))
      named.push_back(file);
  }
  const std::vector<fs::path>& found = named.empty() ? all : named;
  if (found.empty())
    throw InputError(shown(path) +
                     ": contains no map; 16-bit PNG, PFM and float TIFF are expected");
  return found;
}

const fs::path& partnerOfMap(const fs::path& map, std::size_t index, std::size_t count,
                             const std::vector<fs::path>& partners, const std::string& folder) {
  const std::string number = frameDigits(map);
  for (const fs::path& partner : partners)
    if (!number.empty() && frameDigits(partner) == number) return partner;
  if (partners.size() == count && (number.empty() || count == 1)) return partners[index];
  throw InputError(say(shown(map), ": has no partner in ", shown(folder), ", which has ",
                       partners.size(), " maps; names must begin with the same frame number"));
}

/// Inverse of confidenceImage(); NaN for 0 and 255, which do not determine a sigma.
double sigmaOf(std::uint8_t confidence) {
  if (confidence == 0 || confidence == 255) return Statistics::kNone;
  const double wanted = confidence / 255.0;
  double low = 1e-3, high = 1e3;  // px; the share within half a pixel falls with sigma
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (std::erf(0.5 / (middle * std::sqrt(2.0))) > wanted ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

void addSigmas(const Raster<float>& measured, const Raster<float>& truth, const fs::path& file,
               JudgedMap& judged) {
  const GrayImage confidence = readGrayImage(file);
  if (confidence.width_px != measured.width_px || confidence.height_px != measured.height_px)
    throw InputError(say(shown(file), ": has ", confidence.width_px, " x ", confidence.height_px,
                         " pixels, but the map has ", measured.width_px, " x ",
                         measured.height_px));
  std::vector<double> sigma_of(256);
  for (int i = 0; i < 256; ++i)
    sigma_of[static_cast<std::size_t>(i)] = sigmaOf(static_cast<std::uint8_t>(i));
  std::vector<double> errors, sigmas;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    errors.push_back(double(measured.values[i]) - truth.values[i]);
    sigmas.push_back(sigma_of[confidence.values[i]]);
  }
  judged.intervals = intervalCoverage(errors, sigmas);
  judged.sparse = sparsification(errors, sigmas);
}

Raster<float> depthOfDisparity(const Raster<float>& disparity_px, const RectifiedRig& rig) {
  Raster<float> depth_mm = disparity_px;
  const double product = rig.left.fx_px * rig.baseline_mm;
  for (float& value : depth_mm.values)
    value = value > 0 ? static_cast<float>(product / value) : std::nanf("");
  return depth_mm;
}

using MapValue = std::function<double(const JudgedMap&)>;

double meanOverMaps(const DepthMapResult& result, const MapValue& value) {
  std::vector<double> values;
  for (const JudgedMap& map : result.maps) values.push_back(value(map));
  return statistics(values).mean;
}

std::string knownText(double value, int decimals) {
  return std::isnan(value) ? "unknown" : fixed(value, decimals);
}

struct MapColumn {
  const char* key;
  MapValue value;
};

MapValue ofDisparityErrors(std::function<double(const DisparityErrors&)> value) {
  return [value = std::move(value)](const JudgedMap& m) {
    return m.disparity ? value(*m.disparity) : Statistics::kNone;
  };
}

MapValue ofDepthErrors(std::function<double(const DepthErrors&)> value) {
  return [value = std::move(value)](const JudgedMap& m) {
    return m.depth ? value(*m.depth) : Statistics::kNone;
  };
}

std::vector<MapColumn> disparityColumns() {
  using E = const DisparityErrors&;
  return {
      {"epe_px", ofDisparityErrors([](E e) { return e.absolute_px.mean; })},
      {"rmse_px", ofDisparityErrors([](E e) { return e.absolute_px.rmse; })},
      {"median_px", ofDisparityErrors([](E e) { return e.absolute_px.median; })},
      {"bad_1px_percent", ofDisparityErrors([](E e) { return e.bad_percent[0]; })},
      {"bad_2px_percent", ofDisparityErrors([](E e) { return e.bad_percent[1]; })},
      {"bad_3px_percent", ofDisparityErrors([](E e) { return e.bad_percent[2]; })},
      {"coverage_percent", ofDisparityErrors([](E e) { return e.coverage_percent; })},
      {"pixels", ofDisparityErrors([](E e) { return static_cast<double>(e.absolute_px.count); })}};
}

std::vector<MapColumn> depthColumns() {
  using E = const DepthErrors&;
  return {{"mae_mm", ofDepthErrors([](E e) { return e.absolute_mm.mean; })},
          {"rmse_mm", ofDepthErrors([](E e) { return e.absolute_mm.rmse; })},
          {"median_mm", ofDepthErrors([](E e) { return e.absolute_mm.median; })},
          {"bias_mm", ofDepthErrors([](E e) { return e.signed_mm.mean; })},
          {"bad_1mm_percent", ofDepthErrors([](E e) { return e.bad_percent[0]; })},
          {"bad_2mm_percent", ofDepthErrors([](E e) { return e.bad_percent[1]; })},
          {"bad_3mm_percent", ofDepthErrors([](E e) { return e.bad_percent[2]; })},
          {"depth_coverage_percent", ofDepthErrors([](E e) { return e.coverage_percent; })},
          {"depth_pixels",
           ofDepthErrors([](E e) { return static_cast<double>(e.absolute_mm.count); })}};
}

std::vector<MapColumn> sigmaColumns() {
  return {{"within_50_share", [](const JudgedMap& m) { return m.intervals.within_50; }},
          {"within_68_share", [](const JudgedMap& m) { return m.intervals.within_68; }},
          {"within_95_share", [](const JudgedMap& m) { return m.intervals.within_95; }},
          {"half_left", [](const JudgedMap& m) { return m.sparse.halfLeft(); }},
          {"ause", [](const JudgedMap& m) { return m.sparse.area; }}};
}

Json mapMeans(const DepthMapResult& result, const std::vector<MapColumn>& columns) {
  Json json = Json::object();
  for (const MapColumn& column : columns) json[column.key] = meanOverMaps(result, column.value);
  return json;
}

void keepWorst(const std::string& name, const Raster<float>& measured, const Raster<float>& truth,
               double mean_error, WorstMap* worst) {
  if (!(mean_error > worst->mean_error)) return;  // NaN: no pixel evaluated
  *worst = {name, mean_error, measured};
  for (std::size_t i = 0; i < measured.size(); ++i)
    worst->error.values[i] = std::abs(measured.values[i] - truth.values[i]);
}

/// Later warnings repeat the first.
void addWarning(const std::string& warning, DepthMapResult* result) {
  if (!warning.empty() && result->warnings.empty()) result->warnings.push_back(warning);
}

JudgedMap judgeMap(const DepthMapOptions& options, const fs::path& measured_file,
                   const fs::path& true_file, DepthMapResult* result) {
  for (const fs::path& file : {measured_file, true_file}) requireNamedAs(result->kind, file);
  JudgedMap judged;
  judged.name = measured_file.filename().string();
  if (result->kind == MapKind::kDepth) {
    const Raster<float> measured_mm = readDepth(measured_file), truth_mm = readDepth(true_file);
    judged.depth = depthErrors(measured_mm, truth_mm);
    addWarning(oppositesWarning(judged.name, measured_mm, truth_mm), result);
    keepWorst(judged.name, measured_mm, truth_mm, judged.depth->absolute_mm.mean, &result->worst);
    return judged;
  }
  const Raster<float> measured = readDisparity(measured_file), truth = readDisparity(true_file);
  requireDisparities(measured, measured_file);
  requireDisparities(truth, true_file);
  judged.disparity = disparityErrors(measured, truth);
  addWarning(oppositesWarning(judged.name, measured, truth), result);
  keepWorst(judged.name, measured, truth, judged.disparity->absolute_px.mean, &result->worst);
  if (options.calibration.empty()) return judged;
  const RectifiedRig rig = Rectifier(readCalibration(options.calibration)).rig();
  judged.depth = depthErrors(depthOfDisparity(measured, rig), depthOfDisparity(truth, rig));
  return judged;
}

}  // namespace

MapKind DepthMapOptions::mapKind() const {
  std::vector<std::string> names{fs::path(measured).filename().string()};
  if (isFolder(measured))
    for (const fs::path& file : filesIn(measured, kMapFiles))
      names.push_back(file.filename().string());
  const auto named = [&](const char* word) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return name.find(word) != std::string::npos;
    });
  };
  const bool disparity = kind.empty() ? named("disparity") : kind == "disparity";
  const bool depth = kind.empty() ? named("depth") : kind == "depth";
  if (disparity != depth) return disparity ? MapKind::kDisparity : MapKind::kDepth;
  throw OptionError("`map_kind=` is `" + kind + "`, but must be disparity (px) or depth (mm): " +
                    (disparity ? "names in " + shown(measured) + " say both"
                               : shown(measured) + " does not contain the kind in its name"));
}

bool holdsDepthMaps(const fs::path& path) {
  if (!isThere(path)) return false;
  if (!isFolder(path.string())) return isMapName(path);
  if (isThere(path / "trajectory.txt")) return false;
  const std::vector<fs::path> files = filesIn(path, kMapFiles);
  return !files.empty();
}

DepthMapResult judgeDepthMaps(const DepthMapOptions& options, const Progress& progress) {
  DepthMapResult result;
  result.measured = options.measured;
  result.reference = options.reference;
  result.kind = options.mapKind();
  const bool of_depth = result.kind == MapKind::kDepth;
  if (of_depth && !options.confidence.empty())
    throw OptionError("`confidence=` requires disparity maps; give it with a disparity map");
  const std::string part = nameOf(result.kind);
  const auto measured = depthMapsIn(options.measured, part),
             truth = depthMapsIn(options.reference, part);
  std::vector<fs::path> sure;
  if (!options.confidence.empty()) sure = depthMapsIn(options.confidence, "confidence");
  const auto count = static_cast<int>(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    result.interrupted = !reportProgress(progress, static_cast<int>(i), count);
    if (result.interrupted) return result;
    const fs::path& true_file =
        partnerOfMap(measured[i], i, measured.size(), truth, options.reference);
    result.maps.push_back(judgeMap(options, measured[i], true_file, &result));
    if (i == 0) {
      result.measured_unit = unitOfMap(measured[i], result.kind);
      result.true_unit = unitOfMap(true_file, result.kind);
    }
    if (!sure.empty())
      addSigmas(readDisparity(measured[i]), readDisparity(true_file),
                partnerOfMap(measured[i], i, measured.size(), sure, options.confidence),
                result.maps.back());
  }
  reportProgress(progress, count, count);
  return result;
}

VectorDrawing depthMapFigure(const DepthMapResult& result) {
  const bool of_depth = result.kind == MapKind::kDepth;
  MapErrorData data;
  data.title = result.worst.name + ": mean error " + fixed(result.worst.mean_error, 2) +
               (of_depth ? " mm" : " px");
  if (result.maps.size() > 1)
    data.title += ", the largest of " + std::to_string(result.maps.size()) + " maps";
  data.error = result.worst.error;
  data.label = of_depth ? "error of depth [mm]" : "error of disparity [px]";
  return drawMapErrors(data);
}

Json depthMapJson(const DepthMapResult& result) {
  Json json{{"schema_version", 1}, {"softscope", versionText()}, {"command", "evaluate"}};
  json["inputs"] = {{"run", result.measured}, {"reference", result.reference}};
  json["comparison"] = {
      {"reference_kind", result.kind == MapKind::kDepth ? "depth maps" : "disparity maps"},
      {"measured_values", result.measured_unit},
      {"reference_values", result.true_unit},
      {"alignment", "none"}};
  json["maps_judged"] = result.maps.size();
  json["warnings"] = result.warnings;
  json["disparity"] = mapMeans(result, disparityColumns());
  json["depth"] = mapMeans(result, depthColumns());
  json["sigma"] = mapMeans(result, sigmaColumns());
  for (const char* curve : {"removed_share", "mean_left_px", "best_left_px"})
    json["sparsification"][curve] = Json::array();
  for (std::size_t step = 0; step < 10; ++step) {
    const auto at = [&](const std::vector<double> Sparsification::*curve) {
      return meanOverMaps(result, [&](const JudgedMap& m) {
        return (m.sparse.*curve).empty() ? Statistics::kNone : (m.sparse.*curve)[step];
      });
    };
    json["sparsification"]["removed_share"].push_back(double(step) / 10);
    json["sparsification"]["mean_left_px"].push_back(at(&Sparsification::mean_left));
    json["sparsification"]["best_left_px"].push_back(at(&Sparsification::best_left));
  }
  return json;
}

FactSheet depthMapFacts(const DepthMapResult& result) {
  FactSheet facts(result.measured + " against " + result.reference);
  const auto mean = [&](const std::vector<MapColumn>& columns, const char* key, int decimals) {
    for (const MapColumn& column : columns)
      if (std::string(column.key) == key)
        return knownText(meanOverMaps(result, column.value), decimals);
    return std::string();
  };
  facts.addLine("maps", std::to_string(result.maps.size()) + "; values are means over the maps");
  facts.addLine("read as", std::string(nameOf(result.kind)) + ": measured in " +
                               result.measured_unit + "; truth in " + result.true_unit);
  const auto d = disparityColumns(), z = depthColumns(), s = sigmaColumns();
  if (result.kind == MapKind::kDisparity) {
    facts.addLine("disparity",
                  "EPE " + mean(d, "epe_px", 3) + " px, RMSE " + mean(d, "rmse_px", 3) + " px");
    facts.addLine("  bad", mean(d, "bad_1px_percent", 2) + " % above 1 px, " +
                               mean(d, "bad_2px_percent", 2) + " % above 2, " +
                               mean(d, "bad_3px_percent", 2) + " % above 3");
    facts.addLine("  coverage", mean(d, "coverage_percent", 1) +
                                    " % of the pixels with a match in the other image");
  }
  if (!std::isnan(meanOverMaps(result, z[0].value))) {
    facts.addLine("depth", "MAE " + mean(z, "mae_mm", 3) + " mm, RMSE " + mean(z, "rmse_mm", 3) +
                               " mm, bias " + mean(z, "bias_mm", 3) + " mm");
    facts.addLine("  bad", mean(z, "bad_1mm_percent", 2) + " % above 1 mm, " +
                               mean(z, "bad_2mm_percent", 2) + " % above 2, " +
                               mean(z, "bad_3mm_percent", 2) + " % above 3");
    facts.addLine("  coverage",
                  mean(z, "depth_coverage_percent", 1) + " % of the pixels with known depth");
  }
  for (const std::string& warning : result.warnings) facts.warn(warning);
  if (std::isnan(meanOverMaps(result, s[0].value))) return facts;
  const auto percent = [&](const char* key) {
    for (const MapColumn& column : s)
      if (std::string(column.key) == key)
        return knownText(100 * meanOverMaps(result, column.value), 1);
    return std::string();
  };
  facts.addLine("predicted sigma", percent("within_50_share") + ", " + percent("within_68_share") +
                                       " and " + percent("within_95_share") +
                                       " % of the errors within its 50, 68 and 95 % intervals");
  facts.addLine("  sparsification", "EPE without the half with the largest sigma " +
                                        mean(s, "half_left", 3) + " px; AUSE " +
                                        mean(s, "ause", 3));
  return facts;
}

std::string depthMapCsv(const DepthMapResult& result) {
  std::vector<MapColumn> columns = disparityColumns();
  for (const auto& more : {depthColumns(), sigmaColumns()})
    columns.insert(columns.end(), more.begin(), more.end());
  std::string text = "map";
  for (const MapColumn& column : columns) text += std::string(",") + column.key;
  text += "\n";
  for (const JudgedMap& map : result.maps) {
    std::string name = map.name;
    std::replace(name.begin(), name.end(), ',', ' ');
    text += name;
    for (const MapColumn& column : columns) {
      char cell[32] = "";
      if (const double value = column.value(map); std::isfinite(value))
        std::snprintf(cell, sizeof cell, "%.9g", value);
      text += std::string(",") + cell;
    }
    text += "\n";
  }
  return text;
}

}  // namespace softscope
