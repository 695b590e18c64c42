// toolkit/evaluation/evaluate_outputs.cpp: record, tables, figures and error maps.
#include "toolkit/evaluation/evaluate_outputs.h"

#include <cmath>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/images/image_writer.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/evaluation/evaluate_frames.h"
#include "toolkit/evaluation/evaluate_plots.h"
#include "toolkit/record/json_text.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kDotsPerInch = 300;

const char* const kEvaluationFiles[] = {"evaluation.json",
                                        "frames.csv",
                                        "tracks.csv",
                                        "error_series.svg",
                                        "error_series.pdf",
                                        "error_series.png",
                                        "error_histogram.svg",
                                        "error_histogram.pdf",
                                        "error_histogram.png",
                                        "worst_frames.svg",
                                        "worst_frames.pdf",
                                        "worst_frames.png",
                                        "maps.csv",
                                        "error_map.svg",
                                        "error_map.pdf",
                                        "error_map.png",
                                        "errors.pvd",
                                        "drawn_view.png",
                                        "quality_series.svg",
                                        "quality_series.pdf",
                                        "quality_series.png"};

/// Separated by a white gap.
ColourImage sideBySide(const DrawnPair& pair) {
  const int width_px = pair.image.width_px, height_px = pair.image.height_px;
  const int gap_px = std::max(4, width_px / 60);
  ColourImage both(2 * width_px + gap_px, height_px, {255, 255, 255});
  for (int v = 0; v < height_px; ++v) {
    std::copy_n(pair.image.row(v), width_px, both.row(v));
    std::copy_n(pair.model.row(v), width_px, both.row(v) + width_px + gap_px);
  }
  return both;
}

std::string mapName(const ErrorMap& map) { return "errors/" + numberedName(map.frame, ".vtp"); }

/// ParaView collection of the maps over time, or over frames without timestamps.
std::string mapsPvd(const std::vector<ErrorMap>& maps) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const ErrorMap& map : maps)
    text += "<DataSet timestep=\"" +
            exactText(std::isfinite(map.time_s) ? map.time_s : double(map.frame)) + "\" file=\"" +
            mapName(map) + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace

EvaluateOutputs::EvaluateOutputs(fs::path folder, bool overwrite)
    : folder_(std::move(folder)), overwrite_(overwrite) {
  if (fs::exists(folder_) && !fs::is_directory(folder_))
    throw OptionError("`out=` " + shown(folder_) +
                      ": is a file, but must be a new or existing folder");
  for (const fs::path& written : {folder_, folder_ / "errors"}) removeAbandoned(written);
  for (const char* name : kEvaluationFiles) requireWritable(folder_ / name, overwrite_);
}

void EvaluateOutputs::put(const std::string& name, const std::string& bytes) const {
  new_files_.make(folder_ / name, [&] { writeFile(folder_ / name, bytes, overwrite_); });
}

void EvaluateOutputs::putFigure(const std::string& name, const VectorDrawing& figure) const {
  put(name + ".svg", svgBytes(figure));
  put(name + ".pdf", pdfBytes(figure));
  const fs::path png = folder_ / (name + ".png");
  new_files_.make(
      png, [&] { writePng(png, rasterise(figure, kDotsPerInch), kDotsPerInch, overwrite_); });
}

/// Maps of an earlier evaluation are removed: they may belong to other frames.
void EvaluateOutputs::putMaps(const std::vector<ErrorMap>& maps) const {
  if (overwrite_ && fs::is_directory(folder_ / "errors"))
    for (const fs::path& file : filesIn(folder_ / "errors", {".vtp"}))
      if (file.stem().string().find_first_not_of("0123456789") == std::string::npos)
        fs::remove(file);
  if (maps.empty()) return;
  new_files_.makeFolder(folder_ / "errors");
  for (const ErrorMap& map : maps) put(mapName(map), errorMapVtp(map));
  put("errors.pvd", mapsPvd(maps));
}

void EvaluateOutputs::write(const RunEvaluation& evaluation) const {
  new_files_.makeFolder(folder_);
  std::visit([&](const auto& result) { write(result); }, evaluation.result);
  put("evaluation.json", jsonText(evaluation.record));  // last file: all others are complete
  new_files_.keep();
}

void EvaluateOutputs::write(const EvaluationResult& result) const {
  put("frames.csv", frameTable(result).csv());
  if (result.tracks) put("tracks.csv", tracksCsv(*result.tracks));
  if (!result.surface.models.empty()) {
    const std::string title = comparisonTitle(result.run, result.reference);
    const OutcomeStripData strip = outcomeStrip(result);
    putFigure("error_series", withOutcomeStrip(strip, drawErrorSeries(seriesData(result))));
    putFigure("error_histogram",
              withOutcomeStrip(
                  strip, drawErrorHistogram(histogramOf(result.surface.pool.all_mm(), title))));
    putFigure("worst_frames", withOutcomeStrip(strip, drawWorstFrames(worstFramesData(result))));
  }
  putMaps(result.surface.maps);
}

void EvaluateOutputs::write(const TruthlessResult& result) const {
  put("frames.csv", truthlessCsv(result));
  if (!result.last_drawn.image.empty()) {
    const fs::path png = folder_ / "drawn_view.png";
    new_files_.make(
        png, [&] { writePng(png, sideBySide(result.last_drawn), kDotsPerInch, overwrite_); });
  }
  const VectorDrawing plots = truthlessPlots(result);
  if (plots.height_pt > 0) putFigure("quality_series", plots);
}

void EvaluateOutputs::write(const DepthMapResult& result) const {
  put("maps.csv", depthMapCsv(result));
  if (result.worst.mean_error >= 0) putFigure("error_map", depthMapFigure(result));
}

}  // namespace softscope
