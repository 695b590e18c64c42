// toolkit/run/models_on_disk.cpp: headers of PLY files, with tables as fallback.
#include "toolkit/run/models_on_disk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/run/run_folder.h"
#include "toolkit/run/run_reader.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeadBytes = 2048;

/// Numbers after the name of a comment; empty if one is invalid.
std::vector<double> numbersAfter(std::string_view line, std::string_view name) {
  std::vector<double> numbers;
  const std::string begin = "comment " + std::string(name) + " ";
  if (line.substr(0, begin.size()) != begin) return numbers;
  for (const std::string_view word : wordsOf(line.substr(begin.size()))) {
    const auto number = numberOf(word);
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

void readPose(const std::vector<double>& n, ModelOnDisk& model) {
  if (n.size() != 7) return;
  const Eigen::Quaterniond turn(n[6], n[3], n[4], n[5]);
  if (std::abs(turn.norm() - 1) > 0.01) return;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
  model.world_from_left = pose;
}

void readCamera(const std::vector<double>& n, ModelOnDisk& model) {
  if (n.size() != 6 || !(n[0] >= 1 && n[1] >= 1 && n[0] < 1e5 && n[1] < 1e5)) return;
  if (!(n[2] > 0 && n[3] > 0)) return;
  model.left = {int(n[0]), int(n[1]), n[2], n[3], n[4], n[5]};
}

/// Rig of run.json, for models without one.
PinholeCamera readRecordedCamera(const fs::path& run) {
  if (!runHasEnded(run)) return {};
  const auto json = nlohmann::json::parse(readBytes(run / "run.json"), nullptr, false);
  const auto rig = json.is_object() ? json.value("rectified_rig", nlohmann::json()) : json;
  try {
    const double focal_px = rig.at("focal_px");
    return {rig.at("width_px"), rig.at("height_px"),       focal_px,
            focal_px,           rig.at("centre_px").at(0), rig.at("centre_px").at(1)};
  } catch (const nlohmann::json::exception&) {
    return {};  // a record of another version: no frustum
  }
}

bool hasTables(const fs::path& run) { return fs::exists(run / "trajectory.txt"); }

/// For models without these header entries.
void addFromTables(const fs::path& run, std::vector<ModelOnDisk>& models) {
  const auto silent = [](const ModelOnDisk& model) { return !model.world_from_left; };
  if (std::none_of(models.begin(), models.end(), silent) || !hasTables(run)) return;
  const JudgedRun tables = openJudgedRun(run);
  const PinholeCamera left = readRecordedCamera(run);
  for (ModelOnDisk& model : models) {
    if (!silent(model)) continue;
    const auto found = std::lower_bound(tables.frames.begin(), tables.frames.end(), model.frame);
    if (found == tables.frames.end() || *found != model.frame) continue;
    const TimedPose& pose =
        tables.trajectory[static_cast<std::size_t>(found - tables.frames.begin())];
    model.time_s = pose.time_s;
    model.world_from_left = pose.world_from_left;
    if (model.left.width_px == 0) model.left = left;
  }
}

/// model.ply, which belongs to the last frame.
std::vector<ModelOnDisk> lastModelOnly(const fs::path& run) {
  const fs::path file = run / "model.ply";
  if (!fs::exists(file)) return {};
  const int frame = hasTables(run) ? openJudgedRun(run).frames.back() : 0;
  std::vector<ModelOnDisk> models{readModelHead(frame, file)};
  addFromTables(run, models);
  return models;
}

}  // namespace

ModelOnDisk readModelHead(int frame, const fs::path& file) {
  requireFile(file);
  ModelOnDisk model;
  model.frame = frame;
  model.file = file;
  model.time_s = frame;
  std::string head(kHeadBytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(in.gcount()));
  for (const std::string_view line : linesOf(head)) {
    if (line == "end_header") break;
    const std::vector<double> time = numbersAfter(line, "time_s");
    if (time.size() == 1) model.time_s = time[0];
    readPose(numbersAfter(line, "world_from_left"), model);
    readCamera(numbersAfter(line, "left_camera"), model);
  }
  return model;
}

std::vector<ModelOnDisk> findModelsOnDisk(const fs::path& run,
                                          const std::vector<ModelOnDisk>& known) {
  requireFolder(run);
  std::map<int, const ModelOnDisk*> by_frame;
  for (const ModelOnDisk& model : known) by_frame[model.frame] = &model;
  std::vector<ModelOnDisk> models;
  if (fs::is_directory(run / "models"))
    for (const auto& [frame, file] : numberedFiles(run / "models", ".ply")) {
      const auto found = by_frame.find(frame);
      models.push_back(found != by_frame.end() ? *found->second : readModelHead(frame, file));
    }
  if (models.empty()) return lastModelOnly(run);
  addFromTables(run, models);
  return models;
}

bool runHasEnded(const fs::path& run) { return fs::exists(run / "run.json"); }

bool runHasStopped(const fs::path& run) {
  return !runHasEnded(run) && fs::exists(run / kRunLock) && !isHeld(run / kRunLock);
}

std::vector<std::pair<int, Eigen::Vector3f>> readScopePath(const fs::path& run) {
  std::vector<std::pair<int, Eigen::Vector3f>> path;
  if (!hasTables(run)) return path;
  const JudgedRun tables = openJudgedRun(run);
  for (std::size_t k = 0; k < tables.frames.size(); ++k)
    if (tables.isInFirstMap(tables.frames[k]))
      path.emplace_back(tables.frames[k],
                        tables.trajectory[k].world_from_left.translation().cast<float>());
  return path;
}

}  // namespace softscope
