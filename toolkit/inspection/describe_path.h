// toolkit/inspection/describe_path.h: content of a file or folder, whatever it is.
#pragma once

#include <string>

#include "toolkit/record/fact_sheet.h"
#include "vtk_views/volumes/volume_summary.h"

namespace softscope {

struct DescribeOptions {
  bool check_all = false;  // every frame of a sequence, not the first alone
  VolumeOptions volume;
};

/// A sequence, calibration or DICOM folder; an image, video, float map, mesh, volume, calibration
/// or settings file, by its ending. Throws InputError: nothing there, or of an unknown kind; of a
/// folder above clips it names the first of them.
FactSheet describePath(const std::string& path, const DescribeOptions& options = {});

}  // namespace softscope
