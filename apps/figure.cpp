// apps/figure.cpp: `softscope figure`: axial, coronal, sagittal and 3-D in one image.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "core/error.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/figures/draw_figure.h"
#include "toolkit/figures/figure_outputs.h"

namespace softscope {
namespace {

const char* const kFigureDetails =
    "Four panels: axial, coronal and sagittal slices with the contours of all surfaces, and the\n"
    "surfaces in 3-D, coloured by the distance of the test to the reference if both are given.\n"
    "Points (a model of reconstruct) are dots near each plane, those of --scan in red. Without\n"
    "--ct contours are drawn on white. Views are radiological; letters follow the axes of the "
    "data.\n"
    "With a RUN and its sequence as --reference: the model and the true surface in the camera\n"
    "frame, at the last frame with both, or at --frame.\n"
    "For whole runs: --kind frames shows the model at several frames, --kind series its error "
    "maps\n"
    "over time with the series of all frames, --kind compare two runs side by side, --kind\n"
    "matches the matches of dense SURF and SIFT between the model and a new image.\n"
    "A JSON file next to the figure has inputs, hashes, views, range and counts. The same\n"
    "inputs give the same bytes. Research use only.";

class FigureCommand : public Command {
 public:
  std::string name() const override { return "figure"; }
  std::string summary() const override {
    return "axial, coronal, sagittal and 3-D views of CT, reference and model";
  }
  std::string details() const override { return kFigureDetails; }
  std::string example() const override {
    return "softscope figure --ct dicom --reference liver.ply --test run/model.ply --out four.png";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  FigureRequest request_;
  std::string frames_, eye_, align_, align_landmarks_;
};

void FigureCommand::declare(ArgumentList& arguments) {
  arguments.positional("RUN", request_.run,
                       "folder written by reconstruct, with its truth as --reference", false);
  arguments.option("--ct", "VOLUME", request_.ct, "DICOM folder, NIfTI, NRRD or MetaImage");
  arguments.option("--reference", "MESH", request_.reference,
                   "surface of the CT (STL, PLY, OBJ, VTP); for a RUN the sequence with its truth");
  arguments.option("--test", "MODEL", request_.test, "surface or points to compare");
  arguments.option("--surface", "MESH", request_.surfaces,
                   "additional surface or model; repeatable");
  arguments.option("--scan", "POINTS", request_.scans, "points to draw in red; repeatable");
  arguments.option("--kind", "NAME", request_.kind,
                   "four (default), or for a RUN: frames, series, compare, matches");
  arguments.option("--other", "RUN", request_.other, "for --kind compare: the second run");
  arguments.option("--name", "TEXT", request_.names,
                   "for --kind compare: names of the two runs; give it twice");
  arguments.option("--frames", "LIST", frames_,
                   "of the panels, e.g. 0,10,20 (default: up to four, evenly spread)");
  arguments.option("--frame", "N", request_.frame, "of a RUN (default: the last one with truth)");
  arguments.option("--align", "HOW", align_,
                   "test to reference: none (default), landmarks or icp, as in compare");
  arguments.option("--align-landmarks", "FILE", align_landmarks_,
                   "pairs of points, as in compare; alone: --align landmarks");
  arguments.option("--errors", "KIND", request_.errors.kind,
                   "test to reference: absolute (default), signed or none");
  arguments.flag("--observed", request_.observed_only,
                 "for a RUN: errors of the currently visible points, grey for the others");
  arguments.option("--range-mm", "N", request_.errors.range_mm,
                   "end of the colour bar (default: a round number, at least the P95)");
  arguments.option("--eye", "X,Y,Z", eye_, "view direction of the 3-D panel");
  arguments.option("--columns", "N", request_.columns, "1, 2 or 4 panels per row");
  softscope::declare(request_.page, arguments);
}

/// "0,10,20", sorted. Throws OptionError.
std::vector<int> parseFrames(const std::string& text) {
  std::vector<int> frames;
  for (const std::string_view word : wordsOf(text)) {
    const auto frame = numberOf(word);
    if (!frame || !(*frame >= 0 && *frame < 1e9) || *frame != std::floor(*frame))
      throw OptionError("--frames is `" + text + "`, but must be numbers of frames, e.g. 0,10,20");
    frames.push_back(static_cast<int>(*frame));
  }
  std::sort(frames.begin(), frames.end());
  if (const auto twice = std::adjacent_find(frames.begin(), frames.end()); twice != frames.end())
    throw OptionError(say("--frames names ", *twice, " twice; name each frame once"));
  return frames;
}

int FigureCommand::run() {
  request_.frames = parseFrames(frames_);
  if (!eye_.empty()) request_.eye = parseVector(eye_, "--eye");
  request_.fit = parseFit(align_, align_landmarks_, "--align-landmarks");
  const DrawnFigure figure = drawFigure(request_);
  for (const std::string& warning : figure.warnings) spdlog::warn("{}", warning);
  writeFigure(figure.drawing, request_.page, figure.record);
  reportWritten(request_.page.out, request_.page.recordFile());
  if (common.json) printJson(figure.record);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeFigureCommand() { return std::make_unique<FigureCommand>(); }

}  // namespace softscope
