// apps/info.cpp: `softscope info`: content and plausibility of a file.
#include <filesystem>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "core/error.h"
#include "io/files/folder.h"
#include "io/sequences/dataset_form.h"
#include "io/sequences/dataset_search.h"
#include "io/sequences/sequence_paths.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/figures/volume_arguments.h"
#include "toolkit/inspection/describe_file.h"
#include "vtk_views/volumes/volume_summary.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool hasEnding(const std::string& path, std::initializer_list<const char*> endings) {
  const std::string ending = lowerCase(fs::path(path).extension().string());
  for (const char* candidate : endings)
    if (ending == candidate) return true;
  return false;
}

/// Two views, one, or, with a calibration beside it, depth alone.
bool looksLikeSequence(const fs::path& folder) {
  bool depth = false, calibration = false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    std::error_code ignored;  // a link that leads nowhere is the reader's to report
    const bool view = stem == "left" || stem == "right" || stem == "stereo";
    if (view && (entry.is_directory(ignored) || isVideo(entry.path()))) return true;
    depth |= stem == "depth" && entry.is_directory(ignored);
    calibration |= stem == "calibration";
  }
  return depth && calibration;
}

/// For a folder that can't be read itself: throws InputError where clips of data sets lie below it.
void nameClipsBelow(const std::string& folder) {
  const std::vector<FoundClip> clips = clipsBelow(folder);
  if (clips.empty()) return;
  throw InputError(say(shown(folder), ": is no clip itself; clips below it: ", clips.size(),
                       ", the first of them ", shown(clips.front().folder), " (",
                       clips.front().form, "). Name one."));
}

class InfoCommand : public Command {
 public:
  std::string name() const override { return "info"; }
  std::string summary() const override {
    return "what a sequence, image, mesh, volume, calibration or settings file holds";
  }
  std::string details() const override {
    return "Tells size, units, geometry, what is implausible and what is missing.";
  }
  std::string example() const override { return "softscope info my_sequence"; }

  void declare(ArgumentList& arguments) override {
    softscope::declare(volume_, arguments);
    arguments.positional("PATH", path_, "the file or folder", true);
    arguments.flag("--check", check_, "read every frame of a sequence, not the first alone");
    arguments.flag("--patient", patient_,
                   "tell a DICOM series' patient fields and its description as well");
  }

  int run() override {
    volume_.options();
    const FactSheet facts = describe();
    printFacts(facts, common.json);
    return facts.hasProblems() ? kInput : kDone;
  }

 private:
  FactSheet describe() const {
    std::error_code code;
    const fs::file_status status = fs::status(path_, code);
    if (!fs::exists(status))
      throw InputError(path_ + ": does not exist, or is a link that leads nowhere");
    return fs::is_directory(status) ? describeFolder() : describeFile();
  }

  FactSheet describeFolder() const {
    if (looksLikeSequence(path_) || recogniseDataset(path_)) {
      const FactSheet facts = describeSequence(path_, check_);
      if (facts.hasProblems()) nameClipsBelow(path_);
      return facts;
    }
    if (looksLikeVolume(path_)) return describeVolume(path_, volumeOptions());
    try {
      return describeCalibration(path_);
    } catch (const InputError& error) {
      nameClipsBelow(path_);
      throw InputError(path_ +
                       ": is neither a sequence (left/ and right/, left.mp4 and right.mp4, or "
                       "stereo.mp4) nor a DICOM series nor a calibration; as such: " +
                       error.what());
    }
  }

  FactSheet describeFile() const {
    if (isPicture(path_)) return describeImage(path_);
    if (isVideo(path_)) return describeVideo(path_);
    if (hasEnding(path_, {".pfm"})) return describeFloatMap(path_);
    if (hasEnding(path_, {".toml"})) return describeSettings(path_);
    if (hasEnding(path_, {".ply", ".stl", ".obj"})) return describeMesh(path_);
    if (looksLikeVolume(path_)) return describeVolume(path_, volumeOptions());
    if (hasEnding(path_, {".yaml", ".yml", ".xml", ".json", ".txt", ".ini", ".npy"}))
      return describeCalibration(path_);
    throw InputError(
        path_ +
        ": unknown kind of file. Accepted: a sequence folder; images (png, jpg, "
        "bmp, tif, pgm, ppm), pfm, videos; meshes (ply, stl, obj); volumes (nii, nii.gz, "
        "nrrd, mha, DICOM); calibrations (yaml, xml, json, txt, ini, npy); settings (toml)");
  }

  VolumeOptions volumeOptions() const {
    VolumeOptions options = volume_.options();
    options.with_patient = patient_;
    return options;
  }

  std::string path_;
  VolumeArguments volume_;
  bool check_ = false;
  bool patient_ = false;
};

}  // namespace

std::unique_ptr<Command> makeInfoCommand() { return std::make_unique<InfoCommand>(); }

}  // namespace softscope
