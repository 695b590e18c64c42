// tests/toolkit/made_sequences.cpp: options for small images.
#include "tests/toolkit/made_sequences.h"

#include <fstream>
#include <sstream>

#include "support/in_folder.h"
#include "tests/io/temporary_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLongest = 10;  // frames of the clip that others are the beginning of

void simulateAnew(const fs::path& folder, int frames, const std::vector<std::string>& more) {
  SimulateOptions options;
  set({"scope.width_px=160", "scope.height_px=120", "organ.cells_per_side=30"}, &options);
  set(more, &options);
  options.frames = frames;
  simulateSequence(options, {}, folder, /*overwrite=*/false);
}

/// Simulated once for all tests of the program, with the truth of every frame.
const TemporaryFolder& longClip() {
  static const TemporaryFolder folder;
  static const bool made = [] {
    simulateAnew(folder / "clip", kLongest, {"truth_every=1"});
    return true;
  }();
  EXPECT_TRUE(made);
  return folder;
}

bool isNumbered(const fs::path& name) {
  return name.stem().string().find_first_not_of("0123456789") == std::string::npos;
}

/// Whether a clip of this number of frames has this file of a frame:
/// the truth of every fifth and of the last one, the images of all.
bool belongs(const fs::path& name, int frames) {
  const int frame = std::stoi(name.stem().string());
  const bool truth = *name.begin() == "groundtruth";
  return frame < frames && (!truth || frame % 5 == 0 || frame + 1 == frames);
}

/// Keeps the heading and one line per frame.
void cutTable(const fs::path& file, int headings, int frames) {
  std::istringstream lines(textOf(file));
  std::string kept;
  int count = 0;
  for (std::string line; count < headings + frames && std::getline(lines, line); ++count)
    kept += line + "\n";
  std::ofstream(file, std::ios::binary) << kept;
}

/// Keeps the heading and the rows of the first frames.
void cutTracks(const fs::path& file, int frames) {
  std::istringstream lines(textOf(file));
  std::string kept, line;
  std::getline(lines, line);
  kept = line + "\n";
  while (std::getline(lines, line))
    if (std::stoi(line) < frames) kept += line + "\n";
  std::ofstream(file, std::ios::binary) << kept;
}

}  // namespace

ReconstructOptions reconstruction(const fs::path& sequence, const fs::path& run) {
  ReconstructOptions options;
  options.sequence = findSequence(sequence);
  options.name = sequence;
  options.out = run;
  set({"stereo.disparity_max_px=63"}, &options.settings);
  return options;
}

MeasureOptions measurement(const fs::path& sequence, const fs::path& out) {
  MeasureOptions options;
  options.sequence = findSequence(sequence);
  options.name = sequence;
  options.inputs = {{"sequence", sequence}};
  options.numbered = true;
  options.out = out;
  return options;
}

void simulateClip(const fs::path& folder, int frames, const std::vector<std::string>& more) {
  if (!more.empty() || frames > kLongest) return simulateAnew(folder, frames, more);
  const TemporaryFolder& all = longClip();
  for (const auto& entry : fs::recursive_directory_iterator(all / "clip")) {
    const fs::path name = fs::relative(entry.path(), all / "clip");
    if (entry.is_directory()) continue;
    fs::create_directories((folder / name).parent_path());
    if (!isNumbered(name) || belongs(name, frames)) fs::copy_file(entry.path(), folder / name);
  }
  cutTable(folder / "timestamps.txt", 0, frames);
  cutTable(folder / "groundtruth/trajectory.txt", 1, frames);
  cutTracks(folder / "groundtruth/tracks.csv", frames);
}

WorkListener Told::listener() {
  WorkListener listener;
  listener.warning = [this](const std::string& text) { warnings.push_back(text); };
  listener.note = [this](const std::string& text) { notes.push_back(text); };
  listener.failure = [this](const std::string& text) { failures.push_back(text); };
  return listener;
}

const SlopeRun& slopeRun() {
  static const TemporaryFolder folder;
  static const SlopeRun made = [] {
    writeSequence(folder / "clip", 4);
    ReconstructOptions options = reconstruction(folder / "clip", folder / "run");
    options.save_every = 1;
    const ReconstructedRun run = reconstructSequence(options);
    return SlopeRun{folder / "clip", folder / "run", run.record};
  }();
  return made;
}

}  // namespace softscope::test
