// vtk_views/volumes/packed_volume.h: a stored volume as bytes, from a reading process to this one.
#pragma once

#include <string>

#include "vtk_views/volumes/stored_volume.h"

namespace softscope {

/// All but slope and intercept, which are 1 and 0 there.
std::string packVolume(const StoredVolume& volume);

/// Throws Error where the bytes are cut short.
StoredVolume unpackVolume(const std::string& bytes);

}  // namespace softscope
