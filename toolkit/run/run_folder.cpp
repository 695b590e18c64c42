#include "toolkit/run/run_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "core/error.h"
#include "fusion/colour_levels.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/geometry/ply_writer.h"
#include "io/geometry/trajectory_file.h"
#include "io/images/image_writer.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "pipeline/model/active_region.h"
#include "pipeline/model/model_sigma.h"
#include "toolkit/record/json_text.h"
#include "toolkit/run/out_folder.h"
#include "toolkit/run/overlay_finder.h"
#include "toolkit/run/ro_crate.h"
#include "toolkit/run/run_tables.h"
#include "toolkit/run/saved_model.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCheckpoint = "checkpoint.bin";
constexpr std::uintmax_t kCheckpointLimitBytes = std::uintmax_t{8} << 30;
constexpr const char* kImages = "images.csv";
constexpr const char* kKitti = "trajectory_kitti.txt";

const char* const kRunFiles[] = {"model.ply",  "frames.csv", "trajectory.txt", kKitti,
                                 kImages,      "tracks.csv", "models.pvd",     kRecordFile,
                                 kOverlayFile, kCheckpoint,  kCrateFile};

std::string otherMapName(int map) { return say("model_map", map, ".ply"); }

bool isOtherMap(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::size_t first = std::string_view("model_map").size();
  const std::size_t end = name.find_first_not_of("0123456789", first);
  return name.rfind("model_map", 0) == 0 && end > first && end != std::string::npos &&
         name.substr(end) == ".ply";
}

/// Of all maps but `kept`.
void removeOtherMaps(const fs::path& folder, const std::vector<std::string>& kept) {
  std::vector<fs::path> earlier;
  for (const auto& entry : fs::directory_iterator(folder))
    if (isOtherMap(entry.path()) &&
        std::find(kept.begin(), kept.end(), entry.path().filename()) == kept.end())
      earlier.push_back(entry.path());
  for (const fs::path& path : earlier) fs::remove(path);
}

bool holdsRun(const fs::path& folder) {
  for (const char* name : kRunFiles)
    if (fs::exists(folder / name)) return true;
  return fs::exists(folder / kModels);
}

[[noreturn]] void refuseBusy(const fs::path& folder) {
  throw OptionError("`out=` " + shown(folder) +
                    ": another softscope reconstruct is writing to it; wait until it has ended, "
                    "or choose another folder");
}

void requireUsable(const RunFolderOptions& options, bool resume) {
  const fs::path& folder = options.folder;
  if (!fs::exists(folder)) {
    if (resume)
      throw OptionError("`resume=`: there is no " + shown(folder) +
                        "; start the run without `resume=`");
    return;
  }
  if (!fs::is_directory(folder))
    throw OptionError("`out=` " + shown(folder) + ": is a file, but must be a folder");
  if (isHeld(folder / kRunLock)) refuseBusy(folder);
  if (!resume && !options.overwrite && holdsRun(folder))
    throw OptionError("`out=` " + shown(folder) + ": holds a run already; choose another folder, " +
                      (fs::exists(folder / kCheckpoint) ? "continue with `resume=`, " : "") +
                      "or replace it with `overwrite=`");
}

/// Lines of a CSV whose first cell is a frame before `next_frame`.
std::string linesBefore(const fs::path& file, int next_frame) {
  if (!fs::exists(file)) return {};
  std::string kept;
  const std::string bytes = readBytes(file, std::uintmax_t{4} << 30);
  for (const std::string_view line : linesOf(bytes)) {
    if (line.empty() || line.front() < '0' || line.front() > '9') continue;
    if (std::atoi(std::string(line.substr(0, line.find(','))).c_str()) >= next_frame) continue;
    kept.append(line).append("\n");
  }
  return kept;
}

int countLines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// ISO 8601, universal time.
std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 16> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts);
  return text.data();
}

}  // namespace

PointCloud cloudOf(const ModelState& state) {
  if (!state.inactive.empty()) {
    ModelState whole = state;
    activateAll(&whole);
    return cloudOf(whole);
  }
  const PointModel& model = state.model;
  PointCloud cloud{model.positions_mm, model.normals, model.colours, model.weights,
                   modelSigmas(model, state.graph, state.errors)};
  const ColourGain& exposure = state.exposure;
  for (Rgb8& colour : cloud.colours)
    colour = scaled(colour, exposure.red, exposure.green, exposure.blue);
  return cloud;
}

RunFolder::RunFolder(RunFolderOptions options, bool resume) : options_(std::move(options)) {
  require(options_.save_every >= 0, "`save_every=`", options_.save_every, "can't be negative");
  require(options_.checkpoint_every >= 1, "`checkpoint_every=`", options_.checkpoint_every,
          "must be 1 or more");
  requireUsable(options_, resume);
}

std::optional<Checkpoint> RunFolder::readCheckpoint() const {
  const fs::path path = file(kCheckpoint);
  if (!fs::exists(path)) return std::nullopt;
  return parseCheckpoint(readBytes(path, kCheckpointLimitBytes), shown(path));
}

bool RunFolder::wasKilled() const { return fs::exists(file(kRunLock)) && !isHeld(file(kRunLock)); }

/// Until the run or its process has ended: a lock file that no process holds marks a killed run.
void RunFolder::hold() {
  lock_.emplace(file(kRunLock));
  if (!lock_->tryToHold()) refuseBusy(options_.folder);
  for (const fs::path& folder : {options_.folder, file(kModels), file(kNodes)})
    removeTemporaries(folder);  // of a killed process; the lock excludes any other writer
}

std::vector<FrameRecord> RunFolder::earlierFrames() const {
  std::vector<FrameRecord> records;
  for (const std::string_view line : linesOf(frames_csv_))
    if (!line.empty()) records.push_back(readFramesCsvLine(line, shown(file("frames.csv"))));
  return records;
}

void RunFolder::takeOver(int next_frame) {
  begun_ = true;
  hold();
  frames_csv_ = linesBefore(file("frames.csv"), next_frame);
  tracks_csv_ = linesBefore(file("tracks.csv"), next_frame);
  images_csv_ = linesBefore(file(kImages), next_frame);
  trajectory_ = readTrajectory(file("trajectory.txt"));
  const auto frames = static_cast<std::size_t>(countLines(frames_csv_));
  if (trajectory_.size() < frames)
    throw InputError(shown(options_.folder) + ": frames.csv has " + std::to_string(frames) +
                     " frames, trajectory.txt " + std::to_string(trajectory_.size()) +
                     "; they are inconsistent. Start again without `resume=`");
  trajectory_.resize(frames);
  for (const FrameRecord& record : earlierFrames()) placed_.push_back({record.frame, record.map});
  std::size_t line = 0;
  for (const std::string_view text : linesOf(frames_csv_)) {
    if (line >= frames) break;
    const int frame = std::atoi(std::string(text.substr(0, text.find(','))).c_str());
    last_frame_ = frame;
    if (fs::exists(file(kModels) / numberedName(frame, ".ply")))
      saved_.push_back({frame, trajectory_[line].time_s});
    ++line;
  }
}

void RunFolder::begin() {
  if (begun_) return;
  begun_ = true;
  makeFolder(options_.folder);
  hold();
  for (const char* name : kRunFiles) fs::remove(file(name));
  removeOtherMaps(options_.folder, {});
  removeSavedModels(options_.folder);
}

void RunFolder::add(const FrameRecord& record, const FrameNames& names) {
  last_frame_ = record.frame;
  ++unflushed_frames_;
  if (!names.left.empty()) images_csv_ += imagesCsvLine(record.frame, names);
  due_.push_back(record);
  const double time_s = std::isfinite(record.time_s) ? record.time_s : record.frame;
  if (record.join) join(*record.join);
  trajectory_.push_back({time_s, record.world_from_left});
  placed_.push_back({record.frame, record.map});
}

void RunFolder::addRows(const std::vector<FrameRecord>& records) {
  for (const FrameRecord& record : records) {
    frames_csv_ += framesCsvLine(record);
    tracks_csv_ += tracksCsvLines(record);
  }
}

/// All that was written of one map moves into the world of another.
void RunFolder::join(const MapJoin& join) {
  writer_.finish();
  addRows(std::exchange(due_, {}));
  frames_csv_ = moveRows(frames_csv_, join);
  // As a resumed run reads them.
  if (!trajectory_.empty())
    trajectory_ = parseTrajectory(trajectoryText(trajectory_), "trajectory");
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    if (placed_[k].map != join.from) continue;
    placed_[k].map = join.into;
    Eigen::Isometry3d& pose = trajectory_[k].world_from_left;
    const auto saved = std::find_if(saved_.begin(), saved_.end(), [&](const SavedModel& model) {
      return model.frame == placed_[k].frame;
    });
    if (saved != saved_.end())
      moveSavedModel(options_.folder, {saved->frame, saved->time_s, pose, left_}, join.into_from);
    pose = join.into_from * pose;
  }
}

void RunFolder::saveModel(int frame, double time_s, const ModelState& state) {
  begin();
  const ModelMoment moment{frame, std::isfinite(time_s) ? time_s : frame,
                           trajectory_.back().world_from_left, left_};
  writer_.add([this, moment, cloud = cloudOf(state), nodes_mm = state.graph.positions_mm] {
    writeSavedModel(options_.folder, moment, cloud, nodes_mm);
  });
  if (saved_.empty() || saved_.back().frame != frame) saved_.push_back({frame, moment.time_s});
}

std::string RunFolder::modelsPvd() const {
  std::string pvd =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const SavedModel& saved : saved_)
    pvd += say("<DataSet timestep=\"", saved.time_s, "\" file=\"models/",
               numberedName(saved.frame, ".vtp"), "\"/>\n");
  return pvd + "</Collection>\n</VTKFile>\n";
}

void RunFolder::writeOtherMaps(const std::vector<OtherMap>& others) const {
  std::vector<std::string> kept;
  for (const OtherMap& other : others) kept.push_back(otherMapName(other.map));
  removeOtherMaps(options_.folder, kept);
  for (const OtherMap& other : others)
    writePly(file(otherMapName(other.map)), other.cloud, {"world", ""}, true);
}

void RunFolder::writeTables(const Tables& tables) {
  addRows(tables.due);
  const auto write = [&](const char* name, const std::string& text) {
    writeFile(file(name), text, true);
  };
  write("frames.csv", framesCsvHeading() + "\n" + frames_csv_);
  if (options_.tracks) write("tracks.csv", tracksCsvHeading() + "\n" + tracks_csv_);
  if (!tables.images_csv.empty()) write(kImages, imagesCsvHeading() + "\n" + tables.images_csv);
  write("trajectory.txt", trajectoryText(tables.trajectory));
  write(kKitti, kittiText(tables.trajectory));
  if (!tables.models_pvd.empty()) write("models.pvd", tables.models_pvd);
}

void RunFolder::flush(const CheckpointView& checkpoint) {
  begin();
  Tables tables{std::exchange(due_, {}), images_csv_, trajectory_,
                options_.save_every > 0 ? modelsPvd() : std::string()};
  std::vector<OtherMap> others;
  for (const Submap& other : checkpoint.state.others)
    others.push_back({other.scope.map, cloudOf(other.model)});
  writer_.add([this, tables = std::move(tables), cloud = cloudOf(checkpoint.state.model),
               others = std::move(others), state = checkpointBytes(checkpoint)] {
    writeTables(tables);
    writePly(file("model.ply"), cloud, {"world", ""}, true);
    writeOtherMaps(others);
    writeFile(file(kCheckpoint), state, true);  // last: what it continues is complete
  });
  unflushed_frames_ = 0;
}

void RunFolder::saveLastModel(const ModelState& state) {
  if (options_.save_every > 0 && last_frame_ >= 0 && !savesModel(last_frame_))
    saveModel(last_frame_, trajectory_.back().time_s, state);
}

void RunFolder::writeRecord(const FactSheet::Json& record, const Mask& overlay, bool complete) {
  begin();
  writer_.finish();
  if (!overlay.empty()) writePng(file(kOverlayFile), overlay, /*overwrite=*/true);
  writeFile(file(kCrateFile), jsonText(roCrate(options_.folder, record, today())), true);
  writeFile(file(kRecordFile), jsonText(record), true);
  if (complete) fs::remove(file(kCheckpoint));
  fs::remove(file(kRunLock));
}

}  // namespace softscope
