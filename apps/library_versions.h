// apps/library_versions.h: versions of the libraries.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace softscope {

/// Name and version: at run time if the library provides it, else from the build.
std::vector<std::pair<std::string, std::string>> libraryVersions();

}  // namespace softscope
