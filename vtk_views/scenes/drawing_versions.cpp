// vtk_views/scenes/drawing_versions.cpp: versions queried from the libraries.
#include "vtk_views/scenes/drawing_versions.h"

#include <cairo/cairo.h>
#include <fontconfig/fontconfig.h>
#include <vtkDICOMConfig.h>
#include <vtkVersion.h>

namespace softscope {

std::vector<std::pair<std::string, std::string>> drawingLibraryVersions() {
  const int font = FcGetVersion();
  return {{"VTK", vtkVersion::GetVTKVersion()},
          {"vtk-dicom", DICOM_VERSION},
          {"cairo", cairo_version_string()},
          {"fontconfig", std::to_string(font / 10000) + "." + std::to_string(font / 100 % 100) +
                             "." + std::to_string(font % 100)}};
}

}  // namespace softscope
