// src/io/geometry/pfm_file.h: portable float maps (Debevec's PFM), one channel.
#pragma once

#include <string>
#include <string_view>

#include "core/raster.h"

namespace softscope {

/// Reads "Pf": width, height, a scale whose sign gives the byte order (negative = little endian,
/// its size is ignored), then 32-bit floats, the lowest row first. Infinities and NaN become NaN.
/// Throws InputError on colour ("PF"), on a file shorter or longer than its header says.
Raster<float> parsePfm(std::string_view bytes, const std::string& name);

/// Little endian, scale -1. NaN stays NaN.
std::string pfmBytes(const Raster<float>& raster);

}  // namespace softscope
