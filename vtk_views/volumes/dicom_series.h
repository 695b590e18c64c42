// vtk_views/volumes/dicom_series.h: slices in their order, where they lie in the patient.
#pragma once

#include <string>

#include "vtk_views/volumes/stored_volume.h"

namespace softscope {

/// True for a file with DICOM's preamble, or a folder with such a file directly in it.
bool looksLikeDicom(const std::string& path);

/// A DICOM file or folder; values are rescaled already (HU). Every slice is checked: PixelSpacing,
/// ImageOrientationPatient, ImagePositionPatient and the rescaling; the slices are at one distance.
StoredVolume loadDicom(const std::string& path, const VolumeOptions& options);

}  // namespace softscope
