// vtk_views/dicom_series.h: slices in their order, where they lie in the patient.
#pragma once

#include <string>

#include "vtk_views/volume_files.h"

namespace softscope {

/// True for a file with DICOM's preamble, or a folder with such a file directly in it.
bool looksLikeDicom(const std::string& path);

/// loadVolume() for a DICOM file or folder; values are rescaled already (HU).
LoadedVolume loadDicom(const std::string& path, bool with_patient);

}  // namespace softscope
