// apps/export.cpp: `softscope export`: models, and what becomes of them elsewhere.
#include <cctype>
#include <filesystem>
#include <iostream>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "apps/result_output.h"
#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/new_files.h"
#include "io/text/message.h"
#include "toolkit/export/export_dicom.h"
#include "toolkit/export/export_files.h"
#include "toolkit/export/export_input.h"
#include "toolkit/export/export_surface.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

const char* const kDetails =
    "MODEL is a folder that `reconstruct` wrote (its last model, or that of --frame), a PLY of\n"
    "points, or a mesh (PLY, STL, OBJ, VTP, VTK). Points become a surface whose vertices they "
    "are;\n"
    "--points leaves them points. The ending of --out chooses the format:\n"
    "  .ply .vtp    colours, normals, weights; triangles or points\n"
    "  .glb .gltf   colours and normals, in metres by the standard; triangles or points\n"
    "  .obj         colours behind the coordinates (MeshLab, Blender, CloudCompare), normals\n"
    "  .stl         triangles alone\n"
    "  .pvd         all saved models of a run, a .vtp each in the folder beside it, for ParaView\n"
    "  .dcm         MODEL is a PDF or a picture: an encapsulated PDF or a secondary capture; "
    "needs\n"
    "               dcmtk. Without --patient-name and --patient-id it names nobody.\n"
    "docs/export.md tells how the surface is made and what each format keeps.";

class ExportCommand : public Command {
 public:
  std::string name() const override { return "export"; }
  std::string summary() const override {
    return "models as surfaces or points for other programs: PLY, VTP, OBJ, STL, glTF, DICOM";
  }
  std::string details() const override { return kDetails; }
  std::string example() const override {
    return "softscope export run --out model.glb\n"
           "  softscope export run --out models.pvd --every 2\n"
           "  softscope export report.pdf --out report.dcm";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  void requireFit() const;
  void exportModel();
  void exportSeries();
  void exportDicom();
  ModelSurface surfaceOf(const fs::path& file, FactSheet& facts) const;
  void tell(const FactSheet& facts) const;

  std::string input_, out_, unit_;
  SurfaceOptions surface_;
  DicomTexts dicom_;
  int frame_ = -1, every_ = 1;
  double input_unit_mm_ = 1;
  bool points_ = false, force_ = false;
};

void ExportCommand::declare(ArgumentList& arguments) {
  arguments.positional("MODEL", input_, "a run, points or a mesh; for .dcm a PDF or a picture",
                       true);
  arguments.option("--out", "FILE", out_, "what to write; its ending is the format", true);
  arguments.option("--frame", "N", frame_, "of a run: the model that was saved at this frame");
  arguments.option("--every", "N", every_, "for .pvd: each N-th saved model (default 1)");
  arguments.flag("--points", points_, "write the points, no triangles");
  arguments.option("--unit", "UNIT", unit_, "of the file: mm (default), cm or m; glTF: always m");
  arguments.option("--input-unit-mm", "N", input_unit_mm_,
                   "what one unit of MODEL measures: 1000 for metres (default 1)");
  arguments.option("--gap-mm", "N", surface_.gap_mm,
                   "wider gaps between points are holes (default: 5 point spacings)");
  arguments.option("--island-mm2", "N", surface_.least_island_mm2,
                   "smaller pieces are dropped (default 10)");
  arguments.option("--patient-name", "TEXT", dicom_.patient_name, "for .dcm: Family^Given");
  arguments.option("--patient-id", "TEXT", dicom_.patient_id, "for .dcm");
  arguments.option("--title", "TEXT", dicom_.title, "for .dcm: of the document or the series");
  arguments.flag("--force", force_, "overwrite what is there");
}

std::string lowerEnding(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

void ExportCommand::requireFit() const {
  const std::string ending = lowerEnding(out_);
  const bool run = fs::is_directory(input_);
  surface_.validate();
  require(frame_ >= -1, "--frame", frame_, "must be 0 or more");
  if (frame_ >= 0 && !run) throw OptionError("--frame needs a run, but MODEL is a file");
  if (ending == ".dcm") {
    if (!canBecomeDicom(input_))
      throw OptionError(
          "--out is a DICOM file, which takes a PDF (of `report --pdf`) or a picture "
          "as MODEL; for a model draw one with `softscope figure` first");
    return;
  }
  if (!dicom_.patient_name.empty() || !dicom_.patient_id.empty() || !dicom_.title.empty())
    throw OptionError("--patient-name, --patient-id and --title belong to .dcm files; this is `" +
                      shown(out_) + "`");
  if (ending == ".pvd" && (!run || frame_ >= 0))
    throw OptionError("--out is a series (.pvd), which takes a run as MODEL and no --frame");
  if (every_ != 1 && ending != ".pvd") throw OptionError("--every belongs to .pvd files");
  const ModelFormat format = ending == ".pvd" ? ModelFormat::kVtp : formatOf(out_);
  unitOf(unit_, format);
  if (points_ && !holdsPoints(format))
    throw OptionError("--points takes .ply, .vtp, .glb, .gltf or .pvd, because " + ending +
                      " holds triangles alone");
}

ModelSurface ExportCommand::surfaceOf(const fs::path& file, FactSheet& facts) const {
  ModelSurface model = readModelSurface(file, input_unit_mm_);
  if (points_) model.triangles.clear();
  if (!points_ && model.triangles.empty()) model = makeSurface(model, surface_, shown(file), facts);
  return model;
}

void ExportCommand::tell(const FactSheet& facts) const { printFacts(facts, common.json); }

void ExportCommand::exportModel() {
  requireWritable(out_, force_);
  const ModelFormat format = formatOf(out_);
  const LengthUnit unit = unitOf(unit_, format);
  const fs::path file =
      fs::is_directory(input_) ? savedModel(input_, frame_).file : fs::path(input_);
  FactSheet facts(shown(file));
  facts.addQuietly("input", file.string());
  const ModelSurface model = surfaceOf(file, facts);
  writeFile(out_, modelBytes(model, format, unit), force_);
  addModelFacts(model, facts);
  facts.add("unit", "unit", unit.name);
  const std::string colours = colourKeeping(format);
  if (model.vertices.colours.empty() || colours.empty())
    facts.add("colours", "colours", std::string("none"));
  else
    facts.add("colours", "colours", colours);
  facts.add("written to", "out", out_);
  tell(facts);
}

void ExportCommand::exportSeries() {
  requireWritable(out_, force_);
  const std::vector<SavedModel> models = savedModels(input_, every_);
  const LengthUnit unit = unitOf(unit_, ModelFormat::kVtp);
  const fs::path folder = fs::path(out_).replace_extension();
  for (const SavedModel& model : models)
    requireWritable(folder / (model.file.stem().string() + ".vtp"), force_);
  NewFiles files;
  files.makeFolder(folder);
  ProgressBar progress("export", int(models.size()), progressStyle(common.quiet), std::cerr);
  Json frames = Json::array();
  std::string list;
  for (const SavedModel& model : models) {
    FactSheet facts(shown(model.file));
    const ModelSurface surface = surfaceOf(model.file, facts);
    const fs::path file = folder / (model.file.stem().string() + ".vtp");
    const std::string bytes = modelBytes(surface, ModelFormat::kVtp, unit);
    files.make(file, [&] { writeFile(file, bytes, force_); });
    list += pvdLine(model.time_s, fs::path(folder.filename()) / file.filename());
    addModelFacts(surface, facts);
    facts.addQuietly("frame", model.frame);
    facts.addQuietly("time_s", model.time_s);
    facts.addQuietly("out", file.string());
    frames.push_back(facts.json());
    progress.advance();
  }
  files.make(out_, [&] { writeFile(out_, pvdFile(list), force_); });
  files.keep();
  FactSheet facts(shown(input_));
  facts.add("models", "models", int(models.size()));
  facts.add("unit", "unit", unit.name);
  facts.addQuietly("frames", frames);
  facts.add("written to", "out", out_);
  facts.addLine("", shown(folder) + " (one .vtp a model)");
  tell(facts);
}

void ExportCommand::exportDicom() {
  const InterruptGuard interrupt;
  writeDicom(input_, out_, dicom_, force_, [&] { return interrupt.requested(); });
  FactSheet facts(shown(input_));
  facts.add("patient",
            dicom_.patient_name.empty() && dicom_.patient_id.empty() ? "not named" : "as given",
            "anonymous", dicom_.patient_name.empty() && dicom_.patient_id.empty());
  facts.add("written to", "out", out_);
  tell(facts);
}

int ExportCommand::run() {
  requireFit();
  const std::string ending = lowerEnding(out_);
  if (ending == ".dcm")
    exportDicom();
  else if (ending == ".pvd")
    exportSeries();
  else
    exportModel();
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeExportCommand() { return std::make_unique<ExportCommand>(); }

}  // namespace softscope
