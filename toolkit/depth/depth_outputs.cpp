// toolkit/depth/depth_outputs.cpp: files of rasters, point cloud and image.
#include "toolkit/depth/depth_outputs.h"

#include <cmath>
#include <sstream>

#include "core/error.h"
#include "core/nearest_name.h"
#include "core/parallel.h"
#include "io/files/atomic_file.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/ply_writer.h"
#include "io/images/image_writer.h"
#include "stereo/depth/dense_depth.h"
#include "toolkit/depth/frame_statistics.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {
namespace {

constexpr double kConfidentPx = 0.5;
constexpr double kMapStepMm = 0.01;

std::string noteOf(const DepthResult& measured) {
  const FrameStatistics statistics = statisticsOf(measured);
  std::string note = "coverage " + fixed(100 * statistics.coverage.share, 1) + " %";
  if (statistics.coverage.measured_pixels > 0)
    note += ", median depth " + fixed(statistics.median_mm, 1) + " mm";
  if (std::isfinite(statistics.median_sigma_mm))
    note += ", median predicted error " + fixed(statistics.median_sigma_mm, 2) + " mm";
  return note + ". Research use only.";
}

}  // namespace

DepthOutputKinds DepthOutputKinds::parse(const std::string& list) {
  if (list.empty()) return {};
  DepthOutputKinds kinds{false, false, false, false, false, true, false};
  const std::vector<std::string> names{"disparity", "depth",   "confidence",
                                       "cloud",     "picture", "dense"};
  bool* const fields[] = {&kinds.disparity, &kinds.depth,   &kinds.confidence,
                          &kinds.cloud,     &kinds.picture, &kinds.dense};
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      const std::string nearest = nearestName(word, names);
      throw OptionError("`write=`: `" + word + "` is no kind of output" +
                        (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)") +
                        ". Give some of disparity,depth,confidence,cloud,picture,dense");
    }
    *fields[found - names.begin()] = true;
  }
  return kinds;
}

std::vector<std::string> DepthOutputs::names() const {
  std::vector<std::string> names;
  const auto addRaster = [&](const std::string& name) {
    if (options_.kinds.floats) names.push_back(name + ".pfm");
    names.push_back(name + ".png");
  };
  if (options_.kinds.disparity) addRaster("disparity");
  if (options_.kinds.depth) addRaster("depth");
  if (options_.kinds.confidence) names.emplace_back("confidence.png");
  if (options_.kinds.dense)
    names.insert(names.end(), {"dense.pfm", "dense.png", "dense_sigma.pfm"});
  if (options_.kinds.cloud) names.emplace_back("cloud.ply");
  if (options_.kinds.picture) names.emplace_back("picture.png");
  return names;
}

void DepthOutputs::requireFree(const std::vector<std::string>& prefixes) const {
  removeAbandoned(options_.folder);
  requireWritable(summaryFile(), options_.overwrite);
  for (const std::string& prefix : prefixes)
    for (const std::string& name : names())
      requireWritable(file(prefix, name.c_str()), options_.overwrite);
}

void DepthOutputs::write(const std::string& prefix, const DepthResult& measured,
                         const DepthRange& range, const std::string& title) const {
  const bool force = options_.overwrite;
  const bool matched = !measured.disparity.disparity_px.empty();  // else depth is from a file
  new_files_.makeFolder(options_.folder);
  const auto rasters = [&] {
    if (options_.kinds.disparity && matched) {
      const auto& disparity_px = measured.disparity.disparity_px;
      if (options_.kinds.floats)
        make(prefix, "disparity.pfm",
             [&](const auto& path) { writePfm(path, disparity_px, force); });
      make(prefix, "disparity.png",
           [&](const auto& path) { writeDisparityPng(path, disparity_px, force); });
    }
    if (options_.kinds.depth) {
      const auto& depth_mm = measured.depth.depth_mm;
      if (options_.kinds.floats)
        make(prefix, "depth.pfm", [&](const auto& path) { writePfm(path, depth_mm, force); });
      make(prefix, "depth.png",
           [&](const auto& path) { writeDepthPng(path, depth_mm, kMapStepMm, force); });
    }
    if (options_.kinds.confidence && matched)
      make(prefix, "confidence.png",
           [&](const auto& path) { writePng(path, confidenceImage(measured.disparity), force); });
  };
  const auto filled = [&] {
    if (!options_.kinds.dense) return;
    const DepthMap dense = denseDepth(measured.depth, measured.mask);
    make(prefix, "dense.pfm", [&](const auto& path) { writePfm(path, dense.depth_mm, force); });
    make(prefix, "dense.png",
         [&](const auto& path) { writeDepthPng(path, dense.depth_mm, kMapStepMm, force); });
    make(prefix, "dense_sigma.pfm",
         [&](const auto& path) { writePfm(path, dense.sigma_mm, force); });
  };
  const auto drawings = [&] {
    if (options_.kinds.cloud)
      make(prefix, "cloud.ply", [&](const auto& path) {
        writePly(path, measured.cloud, {options_.raw_left ? "raw left" : "left", ""}, force);
      });
    if (options_.kinds.picture)
      make(prefix, "picture.png", [&](const auto& path) {
        writePng(path,
                 drawDepthPicture(measured.left, measured.depth.depth_mm, measured.mask, range,
                                  {title, noteOf(measured)}),
                 force);
      });
  };
  parallelInvoke(rasters, [&] {
    filled();
    drawings();
  });
}

std::vector<std::string> DepthOutputs::writtenFiles(int frames) const {
  std::string files;
  for (const std::string& name : names()) files += name + ", ";
  std::vector<std::string> lines{options_.folder.string()};
  if (frames == 1)
    lines.push_back(files + "summary.json");
  else
    lines.push_back(files.substr(0, files.size() - 2) + " of each of " + std::to_string(frames) +
                    " frames; summary.json");
  if (frames > 1 && !options_.kinds.floats)
    lines.emplace_back("--write disparity,depth,confidence,cloud,picture selects more");
  return lines;
}

void DepthOutputs::writeSummary(const std::string& json) const {
  new_files_.make(summaryFile(), [&] { writeFile(summaryFile(), json, options_.overwrite); });
}

GrayImage confidenceImage(const DisparityMap& disparity) {
  GrayImage confidence(disparity.sigma_px.width_px, disparity.sigma_px.height_px);
  for (std::size_t i = 0; i < confidence.size(); ++i) {
    const double sigma_px = disparity.sigma_px.values[i];
    if (std::isnan(sigma_px) || std::isnan(disparity.disparity_px.values[i])) continue;
    const double probability =
        sigma_px > 0 ? std::erf(kConfidentPx / (sigma_px * std::sqrt(2.0))) : 1.0;
    confidence.values[i] = static_cast<std::uint8_t>(std::lround(255 * probability));
  }
  return confidence;
}

}  // namespace softscope
