// src/io/images/jpeg_damage.h: decoding of JPEG with detection of damage in the coded data.
#pragma once

#include <string>
#include <string_view>

namespace softscope {

/// Reads the coded data of a JPEG with valid markers, without computing pixels: a
/// quarter to a third of the decoding time. Throws InputError for invalid data: a
/// decoder would return an image that is grey or shifted from there on. A flipped
/// bit that leaves valid codes is not detectable: JPEG has no checksum.
void requireSoundJpeg(std::string_view bytes, const std::string& name);

/// Decodes a JPEG of one or three components to `bgr`, width x height x 3 bytes, and checks its
/// coded data as requireSoundJpeg() does, in one pass. False for other kinds and another size.
bool decodeSoundJpeg(std::string_view bytes, const std::string& name, int width_px, int height_px,
                     unsigned char* bgr);

}  // namespace softscope
