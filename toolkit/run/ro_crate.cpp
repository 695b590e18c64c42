// toolkit/run/ro_crate.cpp: one entity per file.
#include "toolkit/run/ro_crate.h"

#include "io/files/folder.h"
#include "toolkit/run/overlay_finder.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

struct CrateFile {
  const char *name, *format, *meaning;
};

const CrateFile kCrateFiles[] = {
    {"model.ply", "model/ply",
     "last model: points with normals, colours, weights, sigmas; mm, world"},
    {"models/", "", "models of single frames (PLY and VTP)"},
    {"models.pvd", "application/xml", "the models over time, for ParaView"},
    {"nodes/", "", "nodes of the warp at the same moments (CSV)"},
    {"trajectory.txt", "text/plain", "pose of the left camera per frame: TUM's form, mm"},
    {"trajectory_kitti.txt", "text/plain", "the same poses in KITTI's form, mm"},
    {"frames.csv", "text/csv", "status of each frame, with the reason"},
    {"images.csv", "text/csv", "image files of each frame"},
    {"tracks.csv", "text/csv", "paths of the tracked points, mm"},
    {kOverlayFile, "image/png", "mask of what stands still in the left image"},
    {kRecordFile, "application/json", "version, configuration, input hashes, timings, summary"}};

/// The record is written last, when all other files exist.
bool isInFolder(const std::filesystem::path& folder, const CrateFile& file) {
  return std::string(file.name) == kRecordFile || isThere(folder / file.name);
}

Json reference(const std::string& id) { return {{"@id", id}}; }

}  // namespace

Json roCrate(const std::filesystem::path& folder, const Json& record, const std::string& date) {
  const std::string program = "#softscope";
  const Json sources = record.value("inputs", Json::object());
  Json graph = Json::array(), parts = Json::array(), inputs = Json::array();
  graph.push_back({{"@id", kCrateFile},
                   {"@type", "CreativeWork"},
                   {"conformsTo", reference("https://w3id.org/ro/crate/1.1")},
                   {"about", reference("./")}});
  for (const CrateFile& file : kCrateFiles)
    if (isInFolder(folder, file)) parts.push_back(reference(file.name));
  for (const auto& [part, input] : sources.items()) inputs.push_back(reference("#input-" + part));
  graph.push_back(
      {{"@id", "./"},
       {"@type", "Dataset"},
       {"name", "Deforming surface model of an endoscopic video"},
       {"description", "Made by softscope reconstruct. Research use only, not for diagnosis."},
       {"datePublished", date},
       {"license", "to be stated by the author"},
       {"hasPart", parts},
       {"mentions", reference("#reconstruction")}});
  for (const CrateFile& file : kCrateFiles) {
    const std::string name = file.name;
    if (!isInFolder(folder, file)) continue;
    Json entity{{"@id", name},
                {"@type", name.back() == '/' ? "Dataset" : "File"},
                {"name", name},
                {"description", file.meaning}};
    if (*file.format != '\0') entity["encodingFormat"] = file.format;
    graph.push_back(std::move(entity));
  }
  for (const auto& [part, input] : sources.items())
    graph.push_back({{"@id", "#input-" + part},
                     {"@type", "CreativeWork"},
                     {"name", part},
                     {"sha256", input.value("sha256", "")}});
  graph.push_back({{"@id", program},
                   {"@type", "SoftwareApplication"},
                   {"name", "softscope"},
                   {"softwareVersion", record.value("softscope", "")}});
  graph.push_back({{"@id", "#reconstruction"},
                   {"@type", "CreateAction"},
                   {"name", "softscope reconstruct"},
                   {"instrument", reference(program)},
                   {"object", inputs},
                   {"result", reference("./")}});
  return {{"@context", "https://w3id.org/ro/crate/1.1/context"}, {"@graph", graph}};
}

}  // namespace softscope
