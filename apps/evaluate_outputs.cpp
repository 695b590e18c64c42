// apps/evaluate_outputs.cpp: numbers first, figures after them.
#include "apps/evaluate_outputs.h"

#include "apps/evaluate_plots.h"
#include "apps/result_output.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/image_writer.h"
#include "io/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kDotsPerInch = 300;

const char* const kFiles[] = {"evaluation.json",     "frames.csv",          "tracks.csv",
                              "error_series.svg",    "error_series.pdf",    "error_series.png",
                              "error_histogram.svg", "error_histogram.pdf", "error_histogram.png",
                              "worst_frames.svg",    "worst_frames.pdf",    "worst_frames.png"};

}  // namespace

EvaluateOutputs::EvaluateOutputs(fs::path folder, bool overwrite)
    : folder_(std::move(folder)), overwrite_(overwrite) {
  if (fs::exists(folder_) && !fs::is_directory(folder_))
    throw OptionError("--out " + shown(folder_) +
                      ": is a file, but must be a folder, there or not yet");
  for (const char* name : kFiles) requireWritable(folder_ / name, overwrite_);
}

void EvaluateOutputs::put(const std::string& name, const std::string& bytes) const {
  writeFile(folder_ / name, bytes, overwrite_);
}

void EvaluateOutputs::putFigure(const std::string& name, const VectorDrawing& figure) const {
  put(name + ".svg", svgBytes(figure));
  put(name + ".pdf", pdfBytes(figure));
  writePng(folder_ / (name + ".png"), rasterise(figure, kDotsPerInch), overwrite_);
}

void EvaluateOutputs::write(const EvaluationResult& result, const FrameTable& frames,
                            const FactSheet::Json& record) const {
  fs::create_directories(folder_);
  put("frames.csv", frames.csv());
  if (result.tracks) put("tracks.csv", tracksCsv(*result.tracks));
  if (!result.surface.models.empty()) {
    const std::string title = comparisonTitle(result.run, result.reference);
    putFigure("error_series", drawErrorSeries(seriesData(result)));
    putFigure("error_histogram",
              drawErrorHistogram(histogramOf(result.surface.pool.all_mm(), title)));
    putFigure("worst_frames", drawWorstFrames(worstFramesData(result)));
  }
  put("evaluation.json", jsonText(record));  // last: who finds it finds the others
}

}  // namespace softscope
