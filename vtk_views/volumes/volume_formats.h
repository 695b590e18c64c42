// vtk_views/volumes/volume_formats.h: our own strict readers of MetaImage, NRRD and NIfTI.
#pragma once

#include <string>

#include "vtk_views/volumes/stored_volume.h"

namespace softscope {

/// The file of one volume; docs/formats.md says what each must hold. Throw InputError that names
/// the field, what it holds, and where there is one the option that states it.
StoredVolume readMetaImage(const std::string& path, const VolumeOptions& options);
StoredVolume readNrrd(const std::string& path, const VolumeOptions& options);
StoredVolume readNifti(const std::string& path, const VolumeOptions& options);

}  // namespace softscope
