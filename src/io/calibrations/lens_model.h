// src/io/calibrations/lens_model.h: refusal of lens models other than OpenCV's for pinhole cameras.
#pragma once

#include <string>
#include <string_view>

#include "io/documents/document.h"

namespace softscope {

/// Throws InputError if the entry `key` names a lens model that is not read: any `value` other than
/// pinhole, plumb_bob, rational_polynomial or a synonym for a model of the distortion, a fisheye
/// model for another key of a lens or model, true for a key of fisheye lenses.
void requirePinholeLens(std::string_view key, std::string_view value, const std::string& name);

/// The same for all entries of a document.
void requirePinholeLens(const Document& document, const std::string& name);

}  // namespace softscope
