// apps/option_names.h: settings of the library in messages, as options of the command line.
#pragma once

#include <string>

namespace softscope {

/// The message with `save_every=`, as the library names a setting, written as --save-every. Other
/// words in backticks are data and stay.
std::string withOptions(const std::string& message);

}  // namespace softscope
