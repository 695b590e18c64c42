// toolkit/figures/figure_outputs.cpp: one drawing in three formats.
#include "toolkit/figures/figure_outputs.h"

#include <filesystem>

#include "io/files/atomic_file.h"
#include "io/files/new_files.h"
#include "io/images/image_writer.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/record/version.h"
#include "vtk_views/drawing/fonts.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

}  // namespace

void writeFigure(const VectorDrawing& drawing, const FigureOptions& options, const Json& record) {
  const double dots_per_inch = options.figureStyle().dots_per_inch;
  NewFiles files;
  for (const std::string& name : options.out) {
    const fs::path file = name;
    if (file.has_parent_path()) files.makeFolder(file.parent_path());
    files.make(file, [&] {
      if (file.extension() == ".png")
        writePng(file, rasterise(drawing, dots_per_inch), dots_per_inch, options.force);
      else
        writeFile(file, file.extension() == ".pdf" ? pdfBytes(drawing) : svgBytes(drawing),
                  options.force);
    });
  }
  files.make(options.recordFile(),
             [&] { writeFile(options.recordFile(), jsonText(record), options.force); });
  files.keep();
}

Json viewJson(const ViewPlane& view, SceneFrame frame, double width_mm) {
  return {{"name", view.name},
          {"centre_mm", vectorJson(view.centre_mm)},
          {"right", vectorJson(view.right)},
          {"up", vectorJson(view.up)},
          {"side_right", sideName(view.right, frame)},
          {"side_up", sideName(view.up, frame)},
          {"width_mm", width_mm}};
}

Json figureRecord(const std::string& command, const FigureOptions& options) {
  const FigureStyle style = options.figureStyle();
  Json record{{"schema_version", 1},
              {"softscope", versionText()},
              {"command", command},
              {"research_use_only", true},
              {"style",
               {{"name", style.name},
                {"width_mm", style.width_mm},
                {"font", figureFont()},
                {"font_pt", style.font_pt},
                {"line_pt", style.line_pt},
                {"dots_per_inch", style.dots_per_inch}}},
              {"sides", options.neurological ? "neurological" : "radiological"}};
  return record;
}

}  // namespace softscope
