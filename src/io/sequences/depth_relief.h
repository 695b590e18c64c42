// src/io/sequences/depth_relief.h: images of a sequence with depth only.
#pragma once

#include <filesystem>
#include <memory>

#include "core/image.h"
#include "io/sequences/picture_source.h"

namespace softscope {

/// Grey relief: deviation of each pixel from its surroundings, in units
/// of the typical relief of the image. It is a property of the tissue,
/// so that image matching can match geometry. Black without depth.
ColourImage reliefOf(const Raster<float>& depth_mm);

/// Folder of depth files, or one file, as relief images.
/// `unit_mm`: as in readDepth(). Throws InputError.
std::unique_ptr<PictureSource> openDepthRelief(const std::filesystem::path& path, double unit_mm);

}  // namespace softscope
