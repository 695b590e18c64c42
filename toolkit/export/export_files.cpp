// toolkit/export/export_files.cpp: writers by file extension.
#include "toolkit/export/export_files.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "core/error.h"
#include "io/text/message.h"
#include "mesh/mesh_writer.h"
#include "toolkit/export/export_gltf.h"
#include "vtk_views/files/surface_vtp.h"

namespace softscope {

ModelFormat formatOf(const std::filesystem::path& file) {
  static const std::map<std::string, ModelFormat> kFormats{
      {".ply", ModelFormat::kPly}, {".vtp", ModelFormat::kVtp}, {".obj", ModelFormat::kObj},
      {".stl", ModelFormat::kStl}, {".glb", ModelFormat::kGlb}, {".gltf", ModelFormat::kGltf}};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  const auto found = kFormats.find(ending);
  if (found != kFormats.end()) return found->second;
  throw OptionError("`out=` is `" + shown(file) +
                    "`, but must end in .ply, .vtp, .obj, .stl, .glb or .gltf; .pvd for all saved "
                    "models of a run, .dcm for a report or an image");
}

bool holdsPoints(ModelFormat format) {
  return format != ModelFormat::kObj && format != ModelFormat::kStl;
}

std::string colourKeeping(ModelFormat format) {
  switch (format) {
    case ModelFormat::kPly:
      return "red, green, blue of each vertex";
    case ModelFormat::kVtp:
      return "array RGB of the vertices";
    case ModelFormat::kObj:
      return "behind the coordinates of each vertex";
    case ModelFormat::kStl:
      return {};
    case ModelFormat::kGlb:
    case ModelFormat::kGltf:
      return "COLOR_0 of the vertices";
  }
  return {};
}

LengthUnit unitOf(const std::string& name, ModelFormat format) {
  const bool gltf = format == ModelFormat::kGlb || format == ModelFormat::kGltf;
  const auto unit = lengthUnitNamed(name.empty() ? (gltf ? "m" : "mm") : name);
  if (!unit) throw OptionError("`unit=` is `" + name + "`, but must be mm, cm or m");
  if (gltf && unit->name != "m")
    throw OptionError("`unit=` is " + name + ", but glTF is in metres by its standard; omit it");
  return *unit;
}

std::string modelBytes(const ModelSurface& surface, ModelFormat format, const LengthUnit& unit) {
  switch (format) {
    case ModelFormat::kPly:
      return plyFile(surface, unit);
    case ModelFormat::kVtp:
      return surfaceVtp(surface, unit);
    case ModelFormat::kObj:
      return objFile(surface, unit);
    case ModelFormat::kStl:
      return stlFile(surface, unit);
    case ModelFormat::kGlb:
      return glbFile(surface);
    case ModelFormat::kGltf:
      return gltfFile(surface);
  }
  throw Error("a format without a writer");
}

}  // namespace softscope
