// toolkit/evaluation/map_kinds.h: check that two maps are of the same kind: depth or disparity.
#pragma once

#include <filesystem>
#include <string>

#include "core/raster.h"

namespace softscope {

enum class MapKind { kDisparity, kDepth };

const char* nameOf(MapKind kind);

/// Throws InputError if the name of the file or of its folder means the other kind.
void requireNamedAs(MapKind kind, const std::filesystem::path& file);

/// Throws InputError for a value above the width of the image.
void requireDisparities(const Raster<float>& disparity_px, const std::filesystem::path& file);

/// Near is a small depth and a large disparity, so maps of different kinds have
/// a negative correlation. Returns a warning in that case, else an empty string.
std::string oppositesWarning(const std::string& name, const Raster<float>& measured,
                             const Raster<float>& truth);

/// Assumed unit of the values: files do not state their unit.
std::string unitOfMap(const std::filesystem::path& file, MapKind kind);

}  // namespace softscope
