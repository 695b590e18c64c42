// toolkit/run/run_folder.h: writer of the folder of `softscope reconstruct`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/frame_range.h"
#include "core/point_cloud.h"
#include "core/trajectory.h"
#include "io/files/file_lock.h"
#include "io/sequences/frame_names.h"
#include "pipeline/checkpoint.h"
#include "pipeline/frame_record.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Held by the process that writes the run, gone when the run has ended.
inline constexpr const char* kRunLock = "writing.lock";

struct RunFolderOptions {
  std::filesystem::path folder;
  int save_every = 10;  // frames between models/NNNNNN.ply; 0: none
  FrameRange frames;    // those that are reconstructed
  bool tracks = false;
  bool overwrite = false;
};

/// Tables and models of one run. Files appear whole; flush() brings all of them up to date, so that
/// what was computed survives whatever comes next.
class RunFolder {
 public:
  /// Throws OptionError where the folder can't be used: a file, a run that is being written, or an
  /// earlier run and no --force.
  /// What an earlier run left is removed with the first flush() or model.
  RunFolder(RunFolderOptions options, bool resume);

  /// The state that an interrupted run left; nothing where there is none. Throws InputError.
  std::optional<Checkpoint> readCheckpoint() const;
  /// Whether the process that wrote the run died: its lock file exists, and no process holds it.
  bool wasKilled() const;
  /// Takes over the tables of the frames before `next_frame`.
  void takeOver(int next_frame);
  /// What takeOver() found in frames.csv, as readFramesCsvLine() has it.
  std::vector<FrameRecord> earlierFrames() const;

  /// `names` without a left one: the images came from no files.
  void add(const FrameRecord& record, const FrameNames& names = {});
  /// Whether it is this frame's turn to have its model saved, or the next one is held out and will
  /// be compared with it.
  bool savesModel(int frame) const {
    return options_.frames.holdsOut(frame + 1) ||
           (options_.save_every > 0 && frame / options_.frames.step % options_.save_every == 0);
  }
  /// Which camera models say that they were seen by.
  void tellCamera(const PinholeCamera& left) { left_ = left; }
  /// models/NNNNNN.ply, which says its moment, and .vtp; nodes/NNNNNN.csv. Of the frame that was
  /// added last.
  void saveModel(int frame, double time_s, const ModelState& state);
  void flush(const CheckpointView& checkpoint);
  /// Of the last frame, where it wasn't its turn.
  void saveLastModel(const ModelState& state);
  /// What data repositories read of the folder, then run.json. `complete`: nothing is left to
  /// resume, so the checkpoint goes.
  void writeRecord(const FactSheet::Json& record, bool complete);

 private:
  struct SavedModel {
    int frame = 0;
    double time_s = 0;
  };
  void begin();
  void hold();
  void writeTables(const ModelState& state);
  std::filesystem::path file(const std::string& name) const { return options_.folder / name; }

  RunFolderOptions options_;
  bool begun_ = false;
  int last_frame_ = -1;  // that was added
  std::string frames_csv_, tracks_csv_, images_csv_;
  Trajectory trajectory_;
  PinholeCamera left_;
  std::vector<SavedModel> saved_;
  std::optional<FileLock> lock_;
};

/// The model as a point cloud with weights, world frame, in the light of the last fused image.
PointCloud cloudOf(const ModelState& state);

}  // namespace softscope
