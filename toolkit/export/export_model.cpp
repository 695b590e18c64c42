// toolkit/export/export_model.cpp: export by file extension.
#include "toolkit/export/export_model.h"

#include <cctype>
#include <filesystem>
#include <utility>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/new_files.h"
#include "io/text/message.h"
#include "toolkit/export/export_files.h"
#include "toolkit/export/export_input.h"
#include "toolkit/export/export_surface.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

std::string lowerEnding(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

ModelSurface surfaceOf(const ExportRequest& request, const fs::path& file, FactSheet& facts) {
  ModelSurface model = readModelSurface(file, request.input_unit_mm);
  if (request.points) model.triangles.clear();
  if (!request.points && model.triangles.empty())
    model = makeSurface(model, request.surface, shown(file), facts);
  return model;
}

/// For a run the model of the selected frame.
fs::path modelFile(const ExportRequest& request) {
  return fs::is_directory(request.input) ? savedModel(request.input, request.frame).file
                                         : fs::path(request.input);
}

ExportResult exportOne(const ExportRequest& request) {
  requireWritable(request.out, request.overwrite);
  const ModelFormat format = formatOf(request.out);
  const LengthUnit unit = unitOf(request.unit, format);
  const fs::path file = modelFile(request);
  FactSheet facts(shown(file));
  facts.addQuietly("input", file.string());
  const ModelSurface model = surfaceOf(request, file, facts);
  writeFile(request.out, modelBytes(model, format, unit), request.overwrite);
  addModelFacts(model, facts);
  facts.add("unit", "unit", unit.name);
  const std::string colours = colourKeeping(format);
  if (model.vertices.colours.empty() || colours.empty())
    facts.add("colours", "colours", std::string("none"));
  else
    facts.add("colours", "colours", colours);
  facts.add("written to", "out", request.out);
  return {facts, false};
}

ExportResult exportSeries(const ExportRequest& request, const Progress& progress) {
  const bool overwrite = request.overwrite;
  requireWritable(request.out, overwrite);
  const std::vector<SavedModel> models = savedModels(request.input, request.every);
  const LengthUnit unit = unitOf(request.unit, ModelFormat::kVtp);
  const fs::path folder = fs::path(request.out).replace_extension();
  const auto fileOf = [&](const SavedModel& model) {
    return folder / (model.file.stem().string() + ".vtp");
  };
  for (const SavedModel& model : models) requireWritable(fileOf(model), overwrite);
  NewFiles files;
  files.makeFolder(folder);
  const int count = static_cast<int>(models.size());
  bool progress_continues = reportProgress(progress, 0, count);
  Json frames = Json::array();
  std::string list;
  for (int i = 0; i < count && progress_continues; ++i) {
    const SavedModel& model = models[static_cast<std::size_t>(i)];
    FactSheet facts(shown(model.file));
    const ModelSurface surface = surfaceOf(request, model.file, facts);
    const fs::path file = fileOf(model);
    const std::string bytes = modelBytes(surface, ModelFormat::kVtp, unit);
    files.make(file, [&] { writeFile(file, bytes, overwrite); });
    list += pvdLine(model.time_s, fs::path(folder.filename()) / file.filename());
    addModelFacts(surface, facts);
    facts.addQuietly("frame", model.frame);
    facts.addQuietly("time_s", model.time_s);
    facts.addQuietly("out", file.string());
    frames.push_back(facts.json());
    progress_continues = reportProgress(progress, i + 1, count);
  }
  FactSheet facts(shown(request.input));
  if (!progress_continues) return {facts, true};
  files.make(request.out, [&] { writeFile(request.out, pvdFile(list), overwrite); });
  files.keep();
  facts.add("models", "models", count);
  facts.add("unit", "unit", unit.name);
  facts.addQuietly("frames", frames);
  facts.add("written to", "out", request.out);
  facts.addLine("", shown(folder) + " (one .vtp a model)");
  return {facts, false};
}

/// Surface of the model as Encapsulated STL.
void exportModelDicom(const ExportRequest& request, const DicomTarget& target, FactSheet& facts) {
  const fs::path file = modelFile(request);
  const ModelSurface model = surfaceOf(request, file, facts);
  writeDicomModel(modelBytes(model, ModelFormat::kStl, unitOf("mm", ModelFormat::kStl)), file,
                  target);
  addModelFacts(model, facts);
  facts.add("unit", "unit", std::string("mm"));
}

ExportResult exportDicom(const ExportRequest& request, const Progress& progress) {
  const DicomTexts& texts = request.dicom;
  requireWritable(request.out, request.overwrite);
  const DicomTarget target{request.out, texts, request.overwrite,
                           [&] { return !reportProgress(progress, 0, 1); }};
  FactSheet facts(shown(request.input));
  const auto becomes = [&](const char* what) { facts.add("becomes", "kind", std::string(what)); };
  switch (dicomKindOf(request.input)) {
    case DicomKind::kDocument:
      writeDicomDocument(request.input, target);
      becomes("Encapsulated PDF");
      break;
    case DicomKind::kPicture:
      writeDicomPicture(request.input, target);
      becomes("Secondary Capture");
      break;
    case DicomKind::kMeasurements:
      facts.add("numbers", "numbers", writeDicomMeasurements(request.input, target));
      becomes("Structured Report (TID 1500)");
      break;
    case DicomKind::kModel:
      exportModelDicom(request, target, facts);
      becomes("Encapsulated STL");
      break;
  }
  const bool anonymous = texts.patient_name.empty() && texts.patient_id.empty();
  facts.add("patient", anonymous ? "not named" : "as given", "anonymous", anonymous);
  facts.add("written to", "out", request.out);
  return {facts, false};
}

}  // namespace

bool ExportRequest::isSeries() const { return lowerEnding(out) == ".pvd"; }

void ExportRequest::validate() const {
  const std::string ending = lowerEnding(out);
  const bool run = fs::is_directory(input);
  surface.validate();
  require(frame >= -1, "`frame=`", frame, "must be 0 or more");
  if (frame >= 0 && !run) throw OptionError("`frame=` needs a run, but MODEL is a file");
  if (ending == ".dcm") {
    if (points)
      throw OptionError("`points=` cannot be used for DICOM, which contains triangles only");
    if (!unit.empty() && unit != "mm") throw OptionError("`unit=` of a DICOM file is mm; omit it");
    if (every != 1) throw OptionError("`every=` belongs to .pvd files");
    return;
  }
  if (!dicom.patient_name.empty() || !dicom.patient_id.empty() || !dicom.title.empty())
    throw OptionError(
        "`patient_name=`, `patient_id=` and `title=` belong to .dcm files; this is `" + shown(out) +
        "`");
  if (ending == ".pvd" && (!run || frame >= 0))
    throw OptionError("`out=` is a series (.pvd), which takes a run as MODEL and no `frame=`");
  if (every != 1 && ending != ".pvd") throw OptionError("`every=` belongs to .pvd files");
  const ModelFormat format = ending == ".pvd" ? ModelFormat::kVtp : formatOf(out);
  unitOf(unit, format);
  if (points && !holdsPoints(format))
    throw OptionError("`points=` takes .ply, .vtp, .glb, .gltf or .pvd, because " + ending +
                      " holds triangles alone");
}

ExportResult exportModel(const ExportRequest& request, const Progress& progress) {
  request.validate();
  if (request.isSeries()) return exportSeries(request, progress);
  if (lowerEnding(request.out) == ".dcm") return exportDicom(request, progress);
  return exportOne(request);
}

}  // namespace softscope
