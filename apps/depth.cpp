// apps/depth.cpp: `softscope depth`: stereo pairs, measured in mm.
#include <map>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/sequence_arguments.h"
#include "apps/shared_arguments.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "io/files/folder.h"
#include "toolkit/depth/measure_sequence.h"

namespace softscope {
namespace {

const char* const kDepthDetails =
    "Writes into DIR, for a sequence with the frame number before each name:\n"
    "  disparity.pfm, disparity.png   px; png with 16 bits, 256 steps per px, 0 = none\n"
    "  depth.pfm, depth.png           mm along the optical axis; png 16 bits, 0.01 mm per step\n"
    "  dense.pfm, dense.png           with --dense: mm, gaps between measured pixels filled\n"
    "  dense_sigma.pfm                with --dense: predicted standard error, mm\n"
    "  confidence.png                 255 x probability of an error below 0.5 px\n"
    "  cloud.ply                      points with normals and colours, mm\n"
    "  picture.png                    left image and depth side by side, with a colour bar\n"
    "  summary.json                   coverage, percentiles, row alignment, times, options\n"
    "For several frames, only depth.png and summary.json are written by default (see --write).\n"
    "Rasters are those of the rectified left camera. Raw pairs are rectified first.\n"
    "--write disparity,confidence needs no calibration: two images or folders are then assumed to\n"
    "be rectified.\n"
    "LEFT alone may be a sequence folder, or an image or video with both views\n"
    "(side by side, top and bottom, interlaced). Settings: stereo.*, sequence.*, calibration.*,\n"
    "depth.source, depth.align_rows; for a wrong key the nearest one is suggested. A custom "
    "stereo\n"
    "network: --set stereo.method=onnx --set stereo.model=FILE.onnx.";

class DepthCommand : public Command {
 public:
  std::string name() const override { return "depth"; }
  std::string summary() const override {
    return "disparity, depth, confidence and point cloud of a stereo pair or sequence";
  }
  std::string details() const override { return kDepthDetails; }
  std::string example() const override {
    return "softscope depth left.png right.png --calibration calibration.yaml --out depth_out";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  MeasureOptions readOptions() const;
  std::map<std::string, std::string> inputs() const;

  SequenceArguments source_;
  std::string out_, range_text_, write_;
  std::string frame_ = "left", backend_ = "auto";
  bool dense_ = false, force_ = false;
  RecordPaths paths_;
  SettingsArguments settings_;
};

void DepthCommand::declare(ArgumentList& arguments) {
  arguments.positional("LEFT", source_.left, "left image, folder of images or video; or a sequence",
                       true);
  arguments.positional("RIGHT", source_.right, "right image, folder or video; not for a sequence",
                       false);
  arguments.option("--out", "DIR", out_, "folder for the results", true);
  source_.declareOptions(arguments);
  arguments.option("--frame", "NAME", frame_,
                   "frame of the point cloud: left (rectified, the default) or raw-left");
  arguments.option("--range", "A:B", range_text_, "range of the colour bar in mm");
  arguments.option("--backend", "NAME", backend_, "auto (the default), cpu or cuda");
  arguments.option("--write", "LIST", write_,
                   "some of disparity,depth,confidence,cloud,picture,dense (default: all for a "
                   "pair, only depth.png for several)");
  arguments.flag(
      "--dense", dense_,
      "additionally depth and its standard error for every pixel that no mask hides, gaps filled");
  arguments.flag("--force", force_, "overwrite existing files");
  softscope::declare(paths_, arguments);
  settings_.declare(arguments);
}

std::map<std::string, std::string> DepthCommand::inputs() const {
  std::map<std::string, std::string> inputs{
      {source_.right.empty() ? "sequence" : "left", source_.left}};
  if (!source_.right.empty()) inputs["right"] = source_.right;
  if (!source_.calibration.empty()) inputs["calibration"] = source_.calibration;
  if (!source_.mask.empty()) inputs["mask"] = source_.mask;
  return inputs;
}

MeasureOptions DepthCommand::readOptions() const {
  require(frame_ == "left" || frame_ == "raw-left", "--frame", frame_, "must be left or raw-left");
  MeasureOptions options;
  if (!range_text_.empty()) options.range = parseDepthRange(range_text_);
  if (!write_.empty()) options.kinds = DepthOutputKinds::parse(write_);
  settingsOf(options.settings).apply(settings_.read());
  source_.applyFrames(options.settings.sequence);
  options.settings.validate();
  options.sequence = source_.paths("depth", !options.uncalibrated());
  options.name = source_.left;
  options.inputs = inputs();
  options.numbered = source_.right.empty() && isFolder(source_.left);
  options.backend = backend_;
  options.out = out_;
  options.raw_left = frame_ == "raw-left";
  options.dense = dense_;
  options.overwrite = force_;
  options.paths = paths_;
  return options;
}

int DepthCommand::run() {
  const InterruptGuard interrupt;
  WorkProgress bar("depth", progressStyle(common.quiet), interrupt);
  WorkListener listener = listenerOf(bar);
  listener.progress = [&, show = bar.callback()](int done, int total) {
    return total > 1 ? show(done, total) : !interrupt.requested();
  };
  const MeasuredSequence measured = measureSequence(readOptions(), listener);
  if (common.json)
    printJson(measured.record);
  else
    printResult(measured.record, measured.facts, measured.files, false);
  return measured.interrupted ? kInterrupted : kDone;
}

}  // namespace

std::unique_ptr<Command> makeDepthCommand() { return std::make_unique<DepthCommand>(); }

}  // namespace softscope
