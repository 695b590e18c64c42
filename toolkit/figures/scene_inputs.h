// toolkit/figures/scene_inputs.h: scene of a figure from files, with a record of what was read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolkit/record/fact_sheet.h"
#include "vtk_views/scenes/scene.h"

namespace softscope {

/// Reads what a figure shows, into LPS.
class SceneInputs {
 public:
  explicit SceneInputs(double unit_mm) : unit_mm_(unit_mm) {}

  /// Throws InputError; OptionError where the window doesn't suit the volume.
  void addVolume(const std::string& path, const std::string& window, const VolumeOptions& options);
  /// A surface or points; from RAS to LPS where its file says RAS. Throws InputError.
  SceneSurface& addSurface(const std::string& path, const std::string& role,
                           const std::string& legend, Rgb8 colour);
  /// What was read elsewhere from `path`, in the scene's frame.
  SceneSurface& addMade(SceneSurface surface, const std::string& role,
                        const std::filesystem::path& path);
  /// The surface of that number is moved to its place; `how` goes into the record.
  void move(std::size_t index, const Eigen::Isometry3d& motion, const std::string& how);
  /// Warns where a surface lies beside the volume, has another unit by the looks of it, or lies in
  /// a scope's frame by its header; where all do and there is no volume, the scene is the scope's.
  void checkPlaces();

  Scene& scene() { return scene_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  void warn(const std::string& text) { warnings_.push_back(text); }
  /// Remembers a file or folder without reading it.
  void note(const std::string& role, const std::string& path);
  /// Role, path, SHA-256 of each input; reads them again.
  FactSheet::Json inputsJson() const;
  /// Geometry and greys; null without a volume.
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

  std::vector<std::string> surface_paths_, assumptions_, frames_;  // one a surface
  bool space_is_said_ = false;                                     // by a surface
  std::vector<std::string> warnings_;
};

}  // namespace softscope
