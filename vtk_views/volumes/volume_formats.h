// vtk_views/volumes/volume_formats.h: own strict readers of MetaImage, NRRD and NIfTI.
#pragma once

#include <string>

#include "vtk_views/volumes/stored_volume.h"

namespace softscope {

/// Reads one volume; requirements: docs/formats.md. Throw InputError
/// with the field, its value, and the option that replaces it, if any.
StoredVolume readMetaImage(const std::string& path, const VolumeOptions& options);
StoredVolume readNrrd(const std::string& path, const VolumeOptions& options);
StoredVolume readNifti(const std::string& path, const VolumeOptions& options);

}  // namespace softscope
