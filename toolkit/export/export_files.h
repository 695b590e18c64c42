// toolkit/export/export_files.h: export formats of a model.
#pragma once

#include <filesystem>
#include <string>

#include "core/model_surface.h"

namespace softscope {

enum class ModelFormat { kPly, kVtp, kObj, kStl, kGlb, kGltf };

/// By the ending, in any case. Throws OptionError naming the endings that there are.
ModelFormat formatOf(const std::filesystem::path& file);

/// Whether the format can hold points without triangles.
bool holdsPoints(ModelFormat format);
/// How it keeps colours, for people; empty where it doesn't.
std::string colourKeeping(ModelFormat format);

/// mm, cm or m; empty: what the format has by itself, m for glTF and mm for all others. Throws
/// OptionError, also for glTF in anything but m.
LengthUnit unitOf(const std::string& name, ModelFormat format);

std::string modelBytes(const ModelSurface& surface, ModelFormat format, const LengthUnit& unit);

}  // namespace softscope
