// apps/calibrate.cpp: `softscope calibrate`: stereo calibration from images of a board.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/files/new_files.h"
#include "io/images/image_writer.h"
#include "io/sequences/sequence_paths.h"
#include "io/text/text_lines.h"
#include "toolkit/calibration/calibration_result.h"
#include "toolkit/calibration/refine_calibration.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

const char* const kCalibrateDetails =
    "LEFT and RIGHT: folders of images or videos of the same times; or LEFT alone with both\n"
    "views in one image. Record a flat board that fills a third to a half of the image: 15 to 30\n"
    "static views, tilted by 20 to 40 degrees to all sides, near and far, in all parts of the "
    "image.\n"
    "Blurred, duplicate and inconsistent views are rejected and named. Writes the calibration\n"
    "with its quality, and next to it an image of the coverage by the board.\n"
    "More examples:\n"
    "  softscope calibrate stereo.mp4 --layout top-bottom --board 9x6 --square 3 --out c.yaml\n"
    "  softscope calibrate left/ right/ --board 8x6 --square 4 --marker 3 --out c.yaml   "
    "(ChArUco)\n"
    "--refine CALIBRATION takes a clip of tissue instead of a board (or a sequence folder as "
    "LEFT):\n"
    "it measures row error, roll and offset between the views and checks the focal length; pitch\n"
    "and roll of the right camera are corrected in the written calibration.\n"
    "  softscope calibrate clip --refine calibration.yaml --out refined.yaml";

class CalibrateCommand : public Command {
 public:
  std::string name() const override { return "calibrate"; }
  std::string summary() const override {
    return "stereo calibration from images of a checkerboard or ChArUco board, with its quality";
  }
  std::string details() const override { return kCalibrateDetails; }
  std::string example() const override {
    return "softscope calibrate left.mp4 right.mp4 --board 9x6 --square 3 --out calibration.yaml";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  BoardFilmOptions filmOptions() const;
  std::vector<double> distances() const;
  void write(const CalibrationReport& report) const;
  int refine(const InterruptGuard& interrupt) const;
  SequencePaths clip() const;

  std::string left_, right_, out_, board_, square_, marker_, coverage_, refine_;
  std::string dictionary_ = "4X4_50", layout_ = "auto", distances_ = "50,80,120";
  int every_ = 0, lens_ = 5;
  bool right_first_ = false, force_ = false;
};

void CalibrateCommand::declare(ArgumentList& arguments) {
  arguments.positional("LEFT", left_, "folder of images or video; alone: both views in one image",
                       true);
  arguments.positional("RIGHT", right_, "the same for the right camera", false);
  arguments.option("--out", "FILE", out_, "calibration to write (YAML)", true);
  arguments.option("--board", "CxR", board_,
                   "inner corners of a checkerboard, squares of a ChArUco board");
  arguments.option("--square", "MM", square_, "side of a square");
  arguments.option("--refine", "CALIBRATION", refine_,
                   "calibration to check and correct with a clip of tissue; without a board");
  arguments.option("--marker", "MM", marker_, "side of a marker: the board is a ChArUco board");
  arguments.option("--dictionary", "NAME", dictionary_, "of the markers (default 4X4_50)");
  arguments.option("--layout", "NAME", layout_,
                   "of both views in one image: side-by-side, top-bottom, interlaced or auto");
  arguments.flag("--right-first", right_first_, "the right view is first in such an image");
  arguments.option("--every", "N", every_, "each n-th frame (default: 300 frames at most)");
  arguments.option("--lens", "N", lens_, "coefficients of distortion: 0, 2, 4 or 5 (default)");
  arguments.option("--distances", "LIST", distances_,
                   "depths in mm for the prediction of errors (default 50,80,120)");
  arguments.option("--coverage", "FILE", coverage_,
                   "image of the coverage (default: FILE of --out with _coverage.png)");
  arguments.flag("--force", force_, "overwrite existing files");
}

double lengthOf(const std::string& option, const std::string& text) {
  const auto value = numberOf(text);
  require(value.has_value() && *value > 0, option, text, "must be a length in mm above 0");
  return *value;
}

/// Integer from 1 to 999, else 0.
int countOf(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 3 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::stoi(text) : 0;
}

BoardFilmOptions CalibrateCommand::filmOptions() const {
  BoardFilmOptions options;
  options.left = left_;
  options.right = right_;
  options.layout = layout_;
  options.right_first = right_first_;
  options.every = every_;
  const std::size_t cross = std::min(board_.find('x'), board_.size());
  options.board.columns = countOf(board_.substr(0, cross));
  options.board.rows = countOf(board_.substr(std::min(cross + 1, board_.size())));
  require(options.board.columns > 0 && options.board.rows > 0, "--board", board_,
          "must be COLUMNSxROWS, e.g. 9x6 (a checkerboard of 10 x 7 squares)");
  options.board.square_mm = lengthOf("--square", square_);
  if (!marker_.empty()) options.board.marker_mm = lengthOf("--marker", marker_);
  options.board.dictionary = dictionary_;
  options.validate();
  return options;
}

std::vector<double> CalibrateCommand::distances() const {
  std::vector<double> distances;
  std::istringstream words(distances_);
  for (std::string word; std::getline(words, word, ',');)
    distances.push_back(lengthOf("--distances", word));
  return distances;
}

void CalibrateCommand::write(const CalibrationReport& report) const {
  NewFiles files;
  const fs::path out = out_, image = coverage_;
  if (!out.parent_path().empty()) files.makeFolder(out.parent_path());
  files.make(out, [&] { writeFile(out, calibrationText(report), force_); });
  files.make(image, [&] { writePng(image, coverageImage(report), force_); });
  files.keep();
}

/// Input as for `depth`, with the calibration to be checked.
SequencePaths CalibrateCommand::clip() const {
  SequencePaths paths;
  if (right_.empty() && isFolder(left_))
    paths = findSequence(left_);
  else if (right_.empty())
    paths.stereo = left_;
  else
    paths.left = left_;
  if (!right_.empty()) paths.right = right_;
  paths.calibration = refine_;
  return paths;
}

int CalibrateCommand::refine(const InterruptGuard& interrupt) const {
  require(board_.empty() && square_.empty() && marker_.empty(), "--refine", refine_,
          "takes a clip of tissue; leave --board, --square and --marker out");
  if (isThere(out_) && !force_)
    throw OptionError(out_ + ": exists already; give another name, or --force to replace it");
  SequenceOptions sequence;
  sequence.layout = layout_;
  sequence.right_first = right_first_;
  RefinedCalibration refined;
  {
    WorkProgress progress("refine", progressStyle(common.quiet), interrupt);
    refined = refineCalibration(clip(), sequence, RefineOptions{}, progress.callback());
  }
  if (refined.stopped) return kInterrupted;
  NewFiles files;
  const fs::path out = out_;
  if (!out.parent_path().empty()) files.makeFolder(out.parent_path());
  files.make(out, [&] { writeFile(out, refinedCalibrationText(refined), force_); });
  files.keep();
  FactSheet facts = refinedCalibrationFacts(refined);
  facts.add("calibration", "calibration", out_);
  printFacts(facts, common.json);
  return kDone;
}

int CalibrateCommand::run() {
  InterruptGuard interrupt;
  if (!refine_.empty()) return refine(interrupt);
  if (board_.empty() || square_.empty())
    throw OptionError(std::string("softscope calibrate: ") +
                      (board_.empty() ? "--board CxR, e.g. 9x6," : "--square MM") +
                      " is missing; --board and --square are needed, or --refine with a clip of "
                      "tissue");
  const BoardFilmOptions film_options = filmOptions();
  SolveOptions options;
  options.bundle.lens_coefficients = lens_;
  options.validate();
  const std::vector<double> distances_mm = distances();
  if (coverage_.empty())
    coverage_ = (fs::path(out_).parent_path() / (fs::path(out_).stem().string() + "_coverage.png"))
                    .string();
  for (const std::string& file : {out_, coverage_})
    if (isThere(file) && !force_)
      throw OptionError(file + ": exists already; give another name, or --force to replace it");

  BoardFilm film;
  {
    WorkProgress progress("calibrate", progressStyle(common.quiet), interrupt);
    film = readBoardFilm(film_options, progress.callback());
  }
  if (film.stopped) return kInterrupted;
  const CalibrationReport report =
      calibrateFromFilm(film, film_options.board, options, distances_mm);
  write(report);
  FactSheet facts = calibrationFacts(report, film);
  facts.add("calibration", "calibration", out_);
  facts.add("coverage image", "coverage_image", coverage_);
  printFacts(facts, common.json);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeCalibrateCommand() { return std::make_unique<CalibrateCommand>(); }

}  // namespace softscope
