// src/io/geometry/pfm_file.h: portable float maps (PFM of Debevec), one channel.
#pragma once

#include <string>
#include <string_view>

#include "core/raster.h"

namespace softscope {

/// Reads "Pf": width, height, a scale whose sign is the byte order (negative = little endian, its
/// magnitude is ignored), then 32-bit floats, lowest row first. Infinities and NaN become NaN.
/// Throws InputError for colour ("PF"), and for a file of another length than that of its header.
Raster<float> parsePfm(std::string_view bytes, const std::string& name);

/// Little endian, scale -1. NaN is preserved.
std::string pfmBytes(const Raster<float>& raster);

}  // namespace softscope
