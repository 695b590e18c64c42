// toolkit/comparison/compare_outputs.cpp: record, coloured surface and figure.
#include "toolkit/comparison/compare_outputs.h"

#include <cmath>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/images/image_writer.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/comparison/compare_map.h"
#include "toolkit/comparison/compare_picture.h"
#include "toolkit/evaluation/evaluate_plots.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/record/json_text.h"
#include "vtk_views/files/error_surface_vtp.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kPrintDotsPerInch = 300;

VertexErrors vertexErrors(const TriangleMesh& test, const SurfaceComparison& comparison) {
  VertexErrors errors;
  for (std::size_t i = 0; i < test.vertices_mm.size(); ++i) {
    const ClosestPoint& closest = comparison.closest[i];
    errors.signed_mm.push_back(closest.signed_distance_mm);
    errors.absolute_mm.push_back(closest.distance_mm);
    errors.to_reference_mm.push_back(
        (closest.point_mm - test.vertices_mm[i].cast<double>()).cast<float>());
  }
  return errors;
}

}  // namespace

CompareOutputs::CompareOutputs(fs::path folder, bool overwrite)
    : folder_(std::move(folder)), overwrite_(overwrite) {
  if (fs::exists(folder_) && !fs::is_directory(folder_))
    throw OptionError("`out=` " + shown(folder_) +
                      ": is a file, but must be a new or existing folder");
  removeAbandoned(folder_);
  for (const char* name : {"comparison.json", "metrics.csv", "errors.vtp", "error_map.vtp",
                           "error_histogram.svg", "error_histogram.pdf", "error_histogram.png",
                           "error_map.svg", "error_map.pdf", "error_map.png"})
    requireWritable(folder_ / name, overwrite_);
}

void CompareOutputs::put(const std::string& name, const std::string& bytes) const {
  new_files_.make(folder_ / name, [&] { writeFile(folder_ / name, bytes, overwrite_); });
}

void CompareOutputs::putFigure(const std::string& name, const VectorDrawing& figure) const {
  put(name + ".svg", svgBytes(figure));
  put(name + ".pdf", pdfBytes(figure));
  const fs::path png = folder_ / (name + ".png");
  new_files_.make(png, [&] {
    writePng(png, rasterise(figure, kPrintDotsPerInch), kPrintDotsPerInch, overwrite_);
  });
}

std::string CompareOutputs::write(const ComparisonResult& result, const TriangleMesh& reference,
                                  const TriangleMesh& test, const ErrorColourOptions& picture,
                                  const FactSheet::Json& record) const {
  new_files_.makeFolder(folder_);
  put("metrics.csv", metricsCsv(record));
  put("errors.vtp", errorSurfaceVtp(test, vertexErrors(test, result.comparison)));
  put("error_map.vtp", errorMapVtp(comparisonMap(result, reference, test)));
  putFigure("error_histogram",
            drawErrorHistogram(histogramOf(result.comparison.accuracy.each_mm,
                                           comparisonTitle(result.test, result.reference))));
  std::string not_drawn;
  try {
    FigureStyle style;
    style.dots_per_inch = kPrintDotsPerInch;
    putFigure("error_map", drawComparison(result, reference, test, picture, style));
  } catch (const BackendError& error) {
    not_drawn = std::string("no error_map: ") + error.what();
  }
  put("comparison.json", jsonText(record));  // last file: all others are complete
  new_files_.keep();
  return not_drawn;
}

std::string metricsCsv(const FactSheet::Json& record) {
  std::string text = "metric,value\n";
  for (const auto& [path, value] : metricsOf(record))
    text += path + "," + (std::isfinite(value) ? exactText(value) : "") + "\n";
  return text;
}

}  // namespace softscope
