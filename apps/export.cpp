// apps/export.cpp: `softscope export`: models for other programs.
#include <spdlog/spdlog.h>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/work_progress.h"
#include "toolkit/export/export_model.h"

namespace softscope {
namespace {

const char* const kExportDetails =
    "MODEL is a folder written by `reconstruct` (its last model, or that of --frame), a PLY of\n"
    "points, or a mesh (PLY, STL, OBJ, VTP, VTK). Points are triangulated and become its "
    "vertices;\n"
    "--points keeps them as points. The file extension of --out selects the format:\n"
    "  .ply .vtp    colours, normals, weights; triangles or points\n"
    "  .glb .gltf   colours and normals, in metres by the standard; triangles or points\n"
    "  .obj         colours after the coordinates (MeshLab, Blender, CloudCompare), normals\n"
    "  .stl         triangles only\n"
    "  .pvd         all saved models of a run, one .vtp each in the folder next to it, for "
    "ParaView\n"
    "  .dcm         by MODEL: a PDF becomes an Encapsulated PDF, the .html of `softscope report` "
    "a\n"
    "               Structured Report (TID 1500) with each of its numbers, an image a Secondary\n"
    "               Capture, a model an Encapsulated STL; needs dcmtk. Name and ID of the patient\n"
    "               are empty unless --patient-name and --patient-id are given.\n"
    "docs/export.md describes the triangulation and the content of each format.";

class ExportCommand : public Command {
 public:
  std::string name() const override { return "export"; }
  std::string summary() const override {
    return "models as surfaces or points for other programs: PLY, VTP, OBJ, STL, glTF, DICOM";
  }
  std::string details() const override { return kExportDetails; }
  std::string example() const override {
    return "softscope export run --out model.glb\n"
           "  softscope export run --out models.pvd --every 2\n"
           "  softscope export report.pdf --out report.dcm\n"
           "  softscope export report.html --out numbers.dcm";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  ExportRequest request_;
};

void ExportCommand::declare(ArgumentList& arguments) {
  arguments.positional("MODEL", request_.input,
                       "a run, points or a mesh; for .dcm also a report or an image", true);
  arguments.option("--out", "FILE", request_.out, "output file; its extension is the format", true);
  arguments.option("--frame", "N", request_.frame, "for a run: the model saved at this frame");
  arguments.option("--every", "N", request_.every, "for .pvd: each N-th saved model (default 1)");
  arguments.flag("--points", request_.points, "write points instead of triangles");
  arguments.option("--unit", "UNIT", request_.unit,
                   "of the file: mm (default), cm or m; glTF: always m");
  arguments.option("--input-unit-mm", "N", request_.input_unit_mm,
                   "mm per unit of MODEL: 1000 for metres (default: as it states, else 1)");
  arguments.option("--gap-mm", "N", request_.surface.gap_mm,
                   "wider gaps between points are holes (default: 5 point spacings)");
  arguments.option("--island-mm2", "N", request_.surface.least_island_mm2,
                   "smaller components are dropped (default 10)");
  arguments.option("--patient-name", "TEXT", request_.dicom.patient_name, "for .dcm: Family^Given");
  arguments.option("--patient-id", "TEXT", request_.dicom.patient_id,
                   "for .dcm: ID of the patient");
  arguments.option("--title", "TEXT", request_.dicom.title,
                   "for .dcm: of the document or the series");
  arguments.flag("--force", request_.overwrite, "overwrite existing files");
}

int ExportCommand::run() {
  const InterruptGuard interrupt;
  WorkProgress progress(
      "export", request_.isSeries() ? progressStyle(common.quiet) : ProgressBar::Style::kSilent,
      interrupt);
  const ExportResult result = exportModel(request_, progress.callback());
  if (result.interrupted) {
    spdlog::warn("interrupted: nothing is written");
    return kInterrupted;
  }
  printFacts(result.facts, common.json);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeExportCommand() { return std::make_unique<ExportCommand>(); }

}  // namespace softscope
