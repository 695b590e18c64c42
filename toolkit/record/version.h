// toolkit/record/version.h: version and compiler of softscope.
#pragma once

#include <string>

namespace softscope {

std::string versionText();   // "0.1.0"
std::string compilerText();  // "GNU 12.2.0, Release"

}  // namespace softscope
