// vtk_views/volumes/packed_volume.h: serialised volume, from a reading process to this one.
#pragma once

#include <string>

#include "vtk_views/volumes/stored_volume.h"

namespace softscope {

/// Without slope and intercept, which are then 1 and 0.
std::string packVolume(const StoredVolume& volume);

/// Throws Error for missing bytes.
StoredVolume unpackVolume(const std::string& bytes);

}  // namespace softscope
