// toolkit/inspection/describe_sequence.cpp: facts,
// missing parts and plausibility of a sequence folder.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

#include "core/error.h"
#include "io/files/folder.h"
#include "io/sequences/dataset_form.h"
#include "io/sequences/picture_source.h"
#include "io/sequences/sequence_reader.h"
#include "io/sequences/timestamps_file.h"
#include "stereo/options/stereo_options.h"
#include "stereo/rectification/rectifier.h"
#include "stereo/rectification/row_alignment.h"
#include "toolkit/inspection/describe_file.h"
#include "toolkit/run/dataset_truth.h"
#include "toolkit/run/stereo_sync.h"
#include "toolkit/run/view_faults.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
constexpr int kFirstPairs = 10;  // of packed views, compared for one that stands still

std::string layoutOf(const SequencePaths& paths) {
  if (!paths.stereo.empty()) return "both views in " + paths.stereo.filename().string();
  if (paths.left.empty()) return "depth only, in " + paths.depth.filename().string();
  const std::string left = paths.left.filename().string();
  if (!paths.depth_files.empty()) return "images with depth in " + left;
  if (!paths.form.empty()) return left + " and " + paths.right.filename().string();
  if (paths.right.empty())
    return "images and depth of one camera, in " + left + " and " + paths.depth.filename().string();
  return fs::is_directory(paths.left)
             ? "images in left/ and right/"
             : "videos " + left + " and " + paths.right.filename().string();
}

void addTimes(const SequencePaths& paths, FactSheet& facts) {
  if (paths.timestamps.empty()) {
    facts.missing("timestamps.txt: frames have no times");
    return;
  }
  const std::vector<double> times_s = readTimestamps(paths.timestamps);
  const double duration_s = times_s.empty() ? 0 : times_s.back() - times_s.front();
  const double rate = duration_s > 0 ? double(times_s.size() - 1) / duration_s : 0;
  facts.add("timestamps", fixed(duration_s, 2) + " s, " + fixed(rate, 2) + " frames a second",
            "duration_s", duration_s);
}

void addCount(const fs::path& folder, const std::string& label, const std::string& key,
              const std::vector<std::string_view>& kinds, FactSheet& facts) {
  if (!fs::is_directory(folder)) return;
  facts.add(label, key, int(filesIn(folder, kinds).size()));
}

/// For a clip of a known data set: its name and ground truth.
void addDataset(const DatasetClip& clip, FactSheet& facts) {
  facts.add("data set", "dataset", clip.form);
  FactSheet::Json list = FactSheet::Json::array();
  for (const fs::path& file : clip.truth) list.push_back(file.filename().string());
  facts.addQuietly("dataset_truth", list);
  facts.addQuietly("dataset_truth_benchmark",
                   clip.benchmark.empty() ? FactSheet::Json() : FactSheet::Json(clip.benchmark));
  if (clip.truth.empty())
    facts.missing("ground truth: the clip can be reconstructed, but not evaluated");
  else
    facts.addLine("truth of the data set", describeTruth(clip));
}

/// Optional parts: masks, depth, ground truth.
void addExtras(const std::string& folder, const SequencePaths& paths, FactSheet& facts) {
  const fs::path truth = fs::path(folder) / "groundtruth";
  if (paths.mask.empty()) facts.missing("mask/: instruments are not masked");
  addCount(paths.mask, "masks", "masks", {".png", ".bmp", ".jpg", ".tif"}, facts);
  if (paths.depth_files.empty())
    addCount(paths.depth, "depth files", "depth_files", {".png", ".pfm", ".tif", ".tiff", ".npy"},
             facts);
  else
    facts.add("depth files", "depth_files", int(paths.depth_files.size()));
  addCount(truth / "mesh", "true meshes", "groundtruth.meshes", {".ply"}, facts);
  addCount(truth / "depth", "true depth", "groundtruth.depth_files",
           {".png", ".pfm", ".tif", ".tiff", ".npy"}, facts);
  for (const char* name : {"trajectory.txt", "tracks.csv"})
    if (fs::exists(truth / name))
      facts.add(std::string("true ") + name, "present",
                std::string("groundtruth.") + fs::path(name).stem().string(), true);
}

void addRows(const FrameResult& first, const ViewOrigin& source, FactSheet& facts) {
  const Frame& frame = first.frame;
  const StereoCalibration& calibration = source.calibration;
  if (frame.pair.right.empty()) return;
  const StereoPair rectified = Rectifier(calibration).rectify(frame.pair);
  const RowAlignment rows =
      measureRowAlignment(toGray(rectified.left), toGray(rectified.right),
                          StereoOptions().forWidth(rectified.left.width_px).disparity_max_px);
  if (!rows.known()) {
    const std::string faults = viewFaults(frame, first.names, source);
    facts.warn(
        "left and right views hardly match in the first frame. Are they of one moment, and not "
        "exchanged?" +
        (faults.empty() ? "" : " Measured: " + faults));
    return;
  }
  facts.add("rows differ by", fixed(rows.mean_row_difference_px, 2) + " px in the first frame",
            "mean_row_difference_px", rows.mean_row_difference_px);
  if (rows.mean_row_difference_px > RowAlignment::kWarnAbovePx)
    facts.warn("rows differ by " + fixed(rows.mean_row_difference_px, 2) +
               " px after rectification, more than 0.5. Is the calibration of this scope? "
               "`softscope depth` reduces the error");
}

/// One warning per unreadable frame, and one for all frames with a view that stands still.
void checkFrames(SequenceReader& reader, FactSheet& facts) {
  int bad = 0, bad_views = 0;
  while (const auto result = reader.next()) {
    bad_views += result->bad_views ? 1 : 0;
    if (result->ok() || result->unpaired) continue;
    facts.warn("frame " + std::to_string(result->index) + ": " + result->error);
    ++bad;
  }
  facts.addQuietly("frames_with_bad_views", bad_views);
  if (bad_views > 0)
    facts.warn("in " + std::to_string(bad_views) + " of " + std::to_string(reader.frameCount()) +
               " frames, one view stands still or both are equal; they are not reconstructed");
  facts.add("unreadable frames", "unreadable_frames", bad);
  if (bad > 0)
    facts.fail(std::to_string(bad) + " of " + std::to_string(reader.frameCount()) +
               " frames can't be read; the warnings name them. Copy or export them again");
}

/// Facts about one view of a sequence that cannot be opened.
void addView(const fs::path& view, const std::string& key, FactSheet& facts) {
  if (view.empty()) return;
  try {
    facts.add(key + " images", key + "_pictures", openPictures(view)->count());
  } catch (const InputError& error) {
    facts.fail(error.what());
  }
}

/// Numbers of file names that are missing in both views, if most are there.
void addGaps(const SequencePaths& paths, FactSheet& facts) {
  if (!fs::is_directory(paths.left)) return;
  std::set<long long> numbers;
  for (const fs::path& file : filesIn(paths.left, {kPictureKinds.begin(), kPictureKinds.end()}))
    if (const auto number = frameNumber(file)) numbers.insert(*number);
  if (numbers.size() < 3) return;
  long long step = *numbers.rbegin() - *numbers.begin();
  for (auto it = std::next(numbers.begin()); it != numbers.end(); ++it)
    step = std::min(step, *it - *std::prev(it));
  long long missing = 0, first = 0;
  for (auto it = std::next(numbers.begin()); it != numbers.end(); ++it) {
    const long long left_out = (*it - *std::prev(it)) / step - 1;
    if (left_out > 0 && missing == 0) first = *std::prev(it) + step;
    missing += left_out;
  }
  if (missing == 0 || missing >= (long long)numbers.size()) return;
  facts.missing("images of " + std::to_string(missing) + " numbers in both views, the first is " +
                std::to_string(first) + "; the images around them are neighbouring frames");
}

/// Warns of the first of the next pairs in one file whose views stand still.
void addStandstill(const SequencePaths& paths, SequenceReader& reader, FactSheet& facts) {
  if (paths.stereo.empty()) return;
  for (int i = 0; i < kFirstPairs; ++i) {
    const auto next = reader.next();
    if (!next) return;
    if (!next->bad_views) continue;
    facts.warn("frame " + std::to_string(next->index) + ": " + next->error);
    return;
  }
}

void addFirstFrame(const std::string& folder, const SequencePaths& paths, bool check_all,
                   FactSheet& facts) {
  SequenceOptions options;
  FrameDepthOptions measured;
  measured.source = "stereo";  // the views are checked, whatever depth there is
  const ViewRelation views = relateViews(paths, measured, options);
  SequenceReader reader(paths, options);
  auto first = reader.next();
  std::string unpaired;
  for (; first && first->unpaired; first = reader.next())
    if (unpaired.empty()) unpaired = folder + ": has no pair, " + first->error;
  if (!first || !first->ok()) throw InputError(first ? first->error : unpaired);
  const ColourImage& left = first->frame.pair.left;
  facts.add("frames", "frames", reader.totalCount());
  facts.add("size", std::to_string(left.width_px) + " x " + std::to_string(left.height_px) + " px",
            "width_px", left.width_px);
  facts.addQuietly("height_px", left.height_px);
  if (!paths.right.empty()) facts.addQuietly("right_offset", options.rightOffset());
  for (const std::string& warning : views.warnings) facts.warn(warning);
  if (!views.bad_views.empty()) facts.warn(views.bad_views);
  addCalibration(reader.calibration(), "calibration", facts);
  addRows(*first, {reader.calibration(), paths, options.right_first}, facts);
  if (const std::string hidden = maskFault(first->frame.mask); !hidden.empty())
    facts.warn("in the first frame, " + hidden);
  if (check_all) return checkFrames(reader, facts);
  addStandstill(paths, reader, facts);
}

}  // namespace

FactSheet describeSequence(const std::string& folder, bool check_all) {
  const SequencePaths paths = findSequence(folder);
  FactSheet facts(folder + ": a sequence");
  facts.addQuietly("kind", "sequence");
  if (!paths.form.empty()) addDataset(*recogniseDataset(folder), facts);
  facts.add("layout", "layout", layoutOf(paths));
  try {
    addFirstFrame(folder, paths, check_all, facts);
  } catch (const InputError& error) {
    facts.fail(error.what());
    addView(paths.left, "left", facts);
    addView(paths.right, "right", facts);
  }
  addTimes(paths, facts);
  addGaps(paths, facts);
  addExtras(folder, paths, facts);
  return facts;
}

}  // namespace softscope
