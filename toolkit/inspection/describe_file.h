// toolkit/inspection/describe_file.h: facts about a file by its kind.
#pragma once

#include <string>

#include "core/stereo_rig.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/volumes/volume_summary.h"

namespace softscope {

// All throw InputError.

/// `check_all`: reads every frame instead of the first only.
FactSheet describeSequence(const std::string& folder, bool check_all);
FactSheet describeImage(const std::string& file);
FactSheet describeFloatMap(const std::string& file);  // PFM
FactSheet describeVideo(const std::string& file);
FactSheet describeMesh(const std::string& file);  // or a PLY with points only
FactSheet describeVolume(const std::string& path, const VolumeOptions& options);
FactSheet describeCalibration(const std::string& path);
FactSheet describeSettings(const std::string& file);

/// Focal length, baseline, field of view, depth per pixel of disparity;
/// warnings. `key`: JSON object of all of them; empty: top level.
void addCalibration(const StereoCalibration& calibration, const std::string& key, FactSheet& facts);

}  // namespace softscope
