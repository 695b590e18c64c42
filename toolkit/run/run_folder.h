// toolkit/run/run_folder.h: writer of the output folder of `softscope reconstruct`.
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
#include "toolkit/run/write_behind.h"

namespace softscope {

/// Locked by the writing process, removed at the end of the run.
inline constexpr const char* kRunLock = "writing.lock";

/// Frames between updates of all files of a run.
inline constexpr int kCheckpointFrames = 100;

struct RunFolderOptions {
  std::filesystem::path folder;
  int save_every = 10;  // frames between models/NNNNNN.ply; 0: none
  FrameRange frames;    // reconstructed frames
  bool tracks = false;
  bool overwrite = false;
  int checkpoint_every = kCheckpointFrames;  // frames between flushes
};

/// Tables and models of one run. Files are written atomically, on a thread of their own; flush()
/// updates all of them, so that the results survive a later failure. Where one can't be written,
/// a later call or writeRecord() throws.
class RunFolder {
 public:
  /// Throws OptionError for an unusable folder: a file, a run
  /// in progress, or an earlier run without --force. The first
  /// flush() or model removes the files of an earlier run.
  RunFolder(RunFolderOptions options, bool resume);

  /// State of an interrupted run; none if absent. Throws InputError.
  std::optional<Checkpoint> readCheckpoint() const;
  /// True if the lock file exists without a lock: the writing process was killed.
  bool wasKilled() const;
  /// Keeps the rows of frames before `next_frame`.
  void takeOver(int next_frame);
  /// Kept rows of frames.csv, as parsed by readFramesCsvLine().
  std::vector<FrameRecord> earlierFrames() const;

  /// `names` without a left name: images not from files.
  void add(const FrameRecord& record, const FrameNames& names = {});
  /// True if the model of this frame is saved: by its number, or
  /// because the next frame is held out and compared with it.
  bool savesModel(int frame) const {
    return options_.frames.holdsOut(frame + 1) ||
           (options_.save_every > 0 && frame / options_.frames.step % options_.save_every == 0);
  }
  /// Camera written into the header of models.
  void tellCamera(const PinholeCamera& left) { left_ = left; }
  /// models/NNNNNN.ply with its frame data, and .vtp;
  /// nodes/NNNNNN.csv. For the frame added last.
  void saveModel(int frame, double time_s, const ModelState& state);
  void flush(const CheckpointView& checkpoint);
  /// True after each `checkpoint_every` frames without flush().
  bool needsFlush() const { return unflushed_frames_ >= options_.checkpoint_every; }
  /// Saves the model of the last frame unless saved before.
  void saveLastModel(const ModelState& state);
  /// Writes the metadata for repositories, then
  /// run.json. `overlay`: RunRecord::overlay(), written if there is any. `complete`: the checkpoint
  /// is removed.
  void writeRecord(const FactSheet::Json& record, const Mask& overlay, bool complete);

 private:
  /// As they are at a flush.
  struct Tables {
    std::vector<FrameRecord> due;
    std::string images_csv;
    Trajectory trajectory;
    std::string models_pvd;
  };
  /// The model of a map that is not in use.
  struct OtherMap {
    int map = 0;
    PointCloud cloud;
  };
  struct SavedModel {
    int frame = 0;
    double time_s = 0;
  };
  struct PlacedFrame {
    int frame = 0;
    int map = 0;  // in whose world the pose is
  };
  void begin();
  void hold();
  void addRows(const std::vector<FrameRecord>& records);
  void writeTables(const Tables& tables);
  std::string modelsPvd() const;
  void writeOtherMaps(const std::vector<OtherMap>& others) const;
  void join(const MapJoin& join);
  std::filesystem::path file(const std::string& name) const { return options_.folder / name; }

  RunFolderOptions options_;
  bool begun_ = false;
  int last_frame_ = -1;  // frame added last
  int unflushed_frames_ = 0;
  std::vector<FrameRecord> due_;         // without rows yet
  std::string frames_csv_, tracks_csv_;  // of the writer, while it works
  std::string images_csv_;
  Trajectory trajectory_;
  std::vector<PlacedFrame> placed_;  // one per pose
  PinholeCamera left_;
  std::vector<SavedModel> saved_;
  std::optional<FileLock> lock_;
  WriteBehind writer_;  // ends before all
};

/// Point cloud with weights, in the world frame, in the illumination of the last fused image.
PointCloud cloudOf(const ModelState& state);

}  // namespace softscope
