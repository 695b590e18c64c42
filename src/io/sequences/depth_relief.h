// src/io/sequences/depth_relief.h: images of a sequence that has depth alone.
#pragma once

#include <filesystem>
#include <memory>

#include "core/image.h"
#include "io/sequences/picture_source.h"

namespace softscope {

/// Grey relief: how far each pixel stands out of its surroundings, in units of the usual relief of
/// the image. It belongs to the tissue, so that what matches images can match geometry. Black where
/// there is no depth.
ColourImage reliefOf(const Raster<float>& depth_mm);

/// A folder of depth files, or one, as relief images. `unit_mm`: as of readDepth(). Throws
/// InputError.
std::unique_ptr<PictureSource> openDepthRelief(const std::filesystem::path& path, double unit_mm);

}  // namespace softscope
