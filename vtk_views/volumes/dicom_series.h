// vtk_views/volumes/dicom_series.h: sorted slices of a DICOM series with their geometry.
#pragma once

#include <string>

#include "vtk_views/volumes/stored_volume.h"

namespace softscope {

/// True for a file with DICOM's preamble, or a folder with such a file directly in it.
bool looksLikeDicom(const std::string& path);

/// DICOM file or folder; values are rescaled (HU). PixelSpacing, ImageOrientationPatient,
/// ImagePositionPatient, rescaling and spacing of every slice are checked.
StoredVolume loadDicom(const std::string& path, const VolumeOptions& options);

}  // namespace softscope
