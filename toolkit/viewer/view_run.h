// toolkit/viewer/view_run.h: models of a finished or running reconstruction, for the viewer.
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "toolkit/figures/volume_arguments.h"
#include "toolkit/run/models_on_disk.h"
#include "toolkit/viewer/view_errors.h"
#include "vtk_views/viewer/view_source.h"

namespace softscope {

/// Texts as given; empty: not given.
struct ViewRunOptions {
  std::string run;
  std::string reference;   // mesh, or sequence with truth
  std::string evaluation;  // folder written by `evaluate`
  std::string ct, window = "auto";
  VolumeArguments volume;
  std::string ct_from_run;  // file
  ErrorColourOptions errors;
};

/// Reads models on demand and caches the last few: memory is constant for long runs.
class RunSource : public ViewSource {
 public:
  /// Throws InputError: no run, no model in it, or another unreadable input.
  explicit RunSource(const ViewRunOptions& options);

  const ViewWorld& world() const override { return world_; }
  int count() const override { return static_cast<int>(models_.size()); }
  int frameOf(int index) const override { return models_[std::size_t(index)].frame; }
  double secondsOf(int index) const override;
  std::shared_ptr<const ViewMoment> moment(int index, bool with_errors) override;
  bool live() const override { return live_; }
  bool stopped() const override { return stopped_; }
  void look() override;

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Kept {
    int frame;
    bool with_errors;
    std::shared_ptr<const ViewMoment> moment;
  };
  ViewMoment read(int index, bool with_errors);
  void addNodes(int index, ViewMoment& moment) const;
  void describeModels();
  void addErrors();
  void addVolume();
  void moveToPatient(ViewMoment& moment) const;

  ViewRunOptions options_;
  std::filesystem::path run_;
  std::vector<ModelOnDisk> models_;
  bool live_ = true, stopped_ = false, clock_ = false;
  ViewWorld world_;
  Eigen::Isometry3d scene_from_run_ = Eigen::Isometry3d::Identity();
  std::unique_ptr<MomentErrors> errors_, reference_;  // if both are set, reference_ is shown
  /// Last reference transformed by moveToPatient(), before and after.
  mutable std::pair<std::shared_ptr<const TriangleMesh>, std::shared_ptr<const TriangleMesh>>
      moved_reference_;
  std::list<Kept> kept_;  // most recently used first
  std::vector<std::string> warnings_;
};

/// Rigid transform from a file: four rows of four numbers, or
/// evaluation.json with an alignment (its mesh_from_run). Throws InputError.
Eigen::Isometry3d readMotion(const std::filesystem::path& file);

}  // namespace softscope
