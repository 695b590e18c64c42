// toolkit/figures/scene_inputs.h: scene of a figure from files, with a record of its inputs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolkit/record/fact_sheet.h"
#include "vtk_views/scenes/scene.h"

namespace softscope {

/// Reader of the content of a figure, into LPS.
class SceneInputs {
 public:
  explicit SceneInputs(double unit_mm) : unit_mm_(unit_mm) {}

  /// Throws InputError; OptionError for a window unsuitable for the volume.
  void addVolume(const std::string& path, const std::string& window, const VolumeOptions& options);
  /// Adds a surface or points, transformed to LPS if the file is in RAS. Throws InputError.
  SceneSurface& addSurface(const std::string& path, const std::string& role,
                           const std::string& legend, Rgb8 colour);
  /// Adds a surface already read from `path`, in the frame of the scene.
  SceneSurface& addMade(SceneSurface surface, const std::string& role,
                        const std::filesystem::path& path);
  /// Moves the surface with this index; `how` is written into the record.
  void move(std::size_t index, const Eigen::Isometry3d& motion, const std::string& how);
  /// Warns about a surface outside of the volume, in a suspected other unit, or in a camera
  /// frame by its header; if all are in a camera frame and there is no volume, so is the scene.
  void checkPlaces();

  Scene& scene() { return scene_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  void warn(const std::string& text) { warnings_.push_back(text); }
  /// Records a file or folder without reading it.
  void note(const std::string& role, const std::string& path);
  /// Role, path and SHA-256 of each input; reads them again.
  FactSheet::Json inputsJson() const;
  /// Geometry and value range; null without a volume.
  FactSheet::Json volumeJson() const;
  FactSheet::Json surfacesJson() const;

 private:
  struct Source {
    std::string role, path;
  };
  double unit_mm_;
  Scene scene_;
  std::vector<Source> sources_;
  void checkFrames();

  std::vector<std::string> surface_paths_, assumptions_, frames_;  // one per surface
  bool space_is_said_ = false;                                     // by the header of a surface
  std::vector<std::string> warnings_;
};

}  // namespace softscope
