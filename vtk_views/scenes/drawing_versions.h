// vtk_views/scenes/drawing_versions.h: versions of the drawing libraries.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace softscope {

/// Name and version of VTK, vtk-dicom, cairo and fontconfig, as loaded at run time.
std::vector<std::pair<std::string, std::string>> drawingLibraryVersions();

}  // namespace softscope
