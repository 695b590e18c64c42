// apps/compare_outputs.cpp: numbers, the surface with its errors, a figure.
#include "apps/compare_outputs.h"

#include <cmath>

#include "apps/evaluate_plots.h"
#include "apps/evaluate_thresholds.h"
#include "apps/result_output.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/image_writer.h"
#include "io/message.h"
#include "io/text_lines.h"
#include "vtk_views/error_surface_vtp.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kDotsPerInch = 300;

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
    throw OptionError("--out " + shown(folder_) +
                      ": is a file, but must be a folder, there or not yet");
  for (const char* name : {"comparison.json", "metrics.csv", "errors.vtp", "error_histogram.svg",
                           "error_histogram.pdf", "error_histogram.png"})
    requireWritable(folder_ / name, overwrite_);
}

void CompareOutputs::write(const ComparisonResult& result, const TriangleMesh& test,
                           const FactSheet::Json& record) const {
  fs::create_directories(folder_);
  const auto put = [&](const char* name, const std::string& bytes) {
    writeFile(folder_ / name, bytes, overwrite_);
  };
  put("metrics.csv", metricsCsv(record));
  put("errors.vtp", errorSurfaceVtp(test, vertexErrors(test, result.comparison)));
  const VectorDrawing figure = drawErrorHistogram(histogramOf(
      result.comparison.accuracy.each_mm, comparisonTitle(result.test, result.reference)));
  put("error_histogram.svg", svgBytes(figure));
  put("error_histogram.pdf", pdfBytes(figure));
  writePng(folder_ / "error_histogram.png", rasterise(figure, kDotsPerInch), overwrite_);
  put("comparison.json", jsonText(record));  // last: who finds it finds the others
}

std::string metricsCsv(const FactSheet::Json& record) {
  std::string text = "metric,value\n";
  for (const auto& [path, value] : metricsOf(record))
    text += path + "," + (std::isfinite(value) ? exactText(value) : "") + "\n";
  return text;
}

}  // namespace softscope
