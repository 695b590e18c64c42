// apps/library_versions.h: versions of the libraries.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace softscope {

/// Name and version: loaded at run time where the library says it, else as built against.
std::vector<std::pair<std::string, std::string>> libraryVersions();

}  // namespace softscope
