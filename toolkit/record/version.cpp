// toolkit/record/version.cpp: values from the build system.
#include "toolkit/record/version.h"

namespace softscope {

std::string versionText() { return SOFTSCOPE_VERSION; }

std::string compilerText() { return SOFTSCOPE_COMPILER ", " SOFTSCOPE_BUILD_TYPE; }

}  // namespace softscope
