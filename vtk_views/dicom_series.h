// vtk_views/dicom_series.h: slices in their order, where they lie in the patient.
#pragma once

#include <string>

#include "vtk_views/volume_summary.h"

namespace softscope {

/// True for a file with DICOM's preamble, or a folder with such a file directly in it.
bool looksLikeDicom(const std::string& path);

/// summariseVolume() for a DICOM file or folder.
VolumeSummary summariseDicom(const std::string& path, bool with_patient);

}  // namespace softscope
