// toolkit/evaluation/map_kinds.h: check that two maps are of the same kind: depth or disparity.
#pragma once

#include <filesystem>
#include <string>

#include "core/raster.h"

namespace softscope {

enum class MapKind { kDisparity, kDepth };

const char* nameOf(MapKind kind);

/// Throws InputError where the name of a file says the other kind, or that of its folder.
void requireNamedAs(MapKind kind, const std::filesystem::path& file);

/// Throws InputError where a value is larger than the width of the image.
void requireDisparities(const Raster<float>& disparity_px, const std::filesystem::path& file);

/// Near is a small depth and a large disparity, so that maps of the two kinds run against each
/// other: a line where `measured` falls while `truth` rises, else nothing.
std::string oppositesWarning(const std::string& name, const Raster<float>& measured,
                             const Raster<float>& truth);

/// What the values of a file are taken for: no file says its unit.
std::string unitOfMap(const std::filesystem::path& file, MapKind kind);

}  // namespace softscope
