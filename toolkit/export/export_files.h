// toolkit/export/export_files.h: export formats of a model.
#pragma once

#include <filesystem>
#include <string>

#include "core/model_surface.h"

namespace softscope {

enum class ModelFormat { kPly, kVtp, kObj, kStl, kGlb, kGltf };

/// By the file extension, case-insensitive. Throws OptionError with the known extensions.
ModelFormat formatOf(const std::filesystem::path& file);

/// True if the format supports points without triangles.
bool holdsPoints(ModelFormat format);
/// Representation of colours, as text; empty without colours.
std::string colourKeeping(ModelFormat format);

/// mm, cm or m; empty: default of the format, m for glTF and mm for all
/// others. Throws OptionError, also for glTF with another unit than m.
LengthUnit unitOf(const std::string& name, ModelFormat format);

std::string modelBytes(const ModelSurface& surface, ModelFormat format, const LengthUnit& unit);

}  // namespace softscope
