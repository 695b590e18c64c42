// toolkit/record/version.cpp: the build system's words.
#include "toolkit/record/version.h"

namespace softscope {

std::string versionText() { return SOFTSCOPE_VERSION; }

std::string compilerText() { return SOFTSCOPE_COMPILER ", " SOFTSCOPE_BUILD_TYPE; }

}  // namespace softscope
