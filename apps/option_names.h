// apps/option_names.h: option names instead of setting names in messages.
#pragma once

#include <string>

namespace softscope {

/// The message with `save_every=`, the setting name of the library, replaced
/// by --save-every. Other words in backticks are data and unchanged.
std::string withOptions(const std::string& message);

}  // namespace softscope
