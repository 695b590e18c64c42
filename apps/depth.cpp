// apps/depth.cpp: `softscope depth`: stereo pairs, measured in mm.
#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>

#include "apps/command.h"
#include "apps/depth_text.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "apps/result_output.h"
#include "apps/sequence_arguments.h"
#include "apps/shared_arguments.h"
#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/sequences/sequence_reader.h"
#include "pipeline/backends.h"
#include "pipeline/run_options.h"
#include "toolkit/depth/depth_estimator.h"
#include "toolkit/depth/depth_outputs.h"
#include "toolkit/depth/depth_record.h"
#include "toolkit/depth/frame_statistics.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/record_paths.h"
#include "toolkit/run/out_folder.h"
#include "toolkit/run/repeated_warnings.h"
#include "toolkit/run/stereo_sync.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

class DepthCommand : public Command {
 public:
  std::string name() const override { return "depth"; }
  std::string summary() const override {
    return "a stereo pair or sequence to disparity, depth, confidence and point cloud";
  }
  std::string details() const override { return kDepthDetails; }
  std::string example() const override {
    return "softscope depth left.png right.png --calibration calibration.yaml --out depth_out";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  void measureAll(SequenceReader& reader, DepthEstimator& estimator, const DepthOutputs& outputs,
                  DepthRecord& record);
  void measureOne(const FrameResult& result, DepthEstimator& estimator, const DepthOutputs& outputs,
                  DepthRecord& record);
  void settleOffset(const SequencePaths& sequence, DepthOptions& options);
  void requireFreeOutputs(const DepthOutputs& outputs, const SequenceReader& reader);
  std::string prefixOf(int index) const;
  std::map<std::string, std::string> inputs() const;

  SequenceArguments source_;
  std::string out_, range_text_, write_;
  std::string frame_ = "left", backend_ = "auto";
  bool force_ = false;
  RecordPaths paths_;
  SettingsArguments settings_;

  bool is_sequence_ = false;  // files are numbered
  RepeatedWarnings failures_{[](const std::string& text) { spdlog::error("{}", text); }};
  RepeatedWarnings warnings_{[](const std::string& text) { spdlog::warn("{}", text); }};
  bool interrupted_ = false;
  std::string failure_;  // of the back end in the middle of the sequence
  std::optional<InterruptGuard> interrupt_;
  std::optional<DepthRange> range_;
};

void DepthCommand::declare(ArgumentList& arguments) {
  arguments.positional("LEFT", source_.left,
                       "left picture, folder of pictures or video; or a sequence", true);
  arguments.positional("RIGHT", source_.right, "right picture, folder or video; not for a sequence",
                       false);
  arguments.option("--out", "DIR", out_, "folder for the results", true);
  source_.declareOptions(arguments);
  arguments.option("--frame", "NAME", frame_,
                   "frame of the point cloud: left (rectified, the default) or raw-left");
  arguments.option("--range", "A:B", range_text_, "mm that the picture's colour bar spans");
  arguments.option("--backend", "NAME", backend_, "auto (the default), cpu or cuda");
  arguments.option("--write", "LIST", write_,
                   "some of disparity,depth,confidence,cloud,picture (default: all of a pair, "
                   "depth.png alone of several)");
  arguments.flag("--force", force_, "overwrite what is there");
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

int DepthCommand::run() {
  interrupt_.emplace();
  require(frame_ == "left" || frame_ == "raw-left", "--frame", frame_, "must be left or raw-left");
  if (!range_text_.empty()) range_ = parseDepthRange(range_text_);
  DepthOutputKinds kinds = DepthOutputKinds::parse(write_);
  DepthOptions options;
  SettingsBinder binder = settingsOf(options);
  binder.apply(settings_.read());
  source_.applyFrames(options.sequence);
  options.validate();

  const bool in_px = kinds.onlyPixels();
  options.sequence.uncalibrated = in_px;
  const SequencePaths sequence = source_.paths("depth", !in_px);
  settleOffset(sequence, options);
  SequenceReader reader(sequence, options.sequence);
  for (const std::string& warning : reader.calibration().warnings) spdlog::warn("{}", warning);
  is_sequence_ = reader.totalCount() > 1 || (source_.right.empty() && isFolder(source_.left));
  if (write_.empty() && reader.frameCount() > 1) kinds = DepthOutputKinds::ofSequence();
  const DepthOutputs outputs({out_, kinds, force_, frame_ == "raw-left"});
  requireApart(out_, sequence);
  requireFreeOutputs(outputs, reader);
  // To wake a GPU takes longer than one pair does on the processor.
  const bool one_pair = backend_ == "auto" && reader.frameCount() == 1;
  auto chosen =
      makeFrameDepth(one_pair ? "cpu" : backend_, reader.calibration(), options.measurement);
  if (!chosen.why.empty()) spdlog::info("back end: {} ({})", chosen.name, chosen.why);
  DepthEstimator estimator(std::move(chosen.part), chosen.name, frame_ == "raw-left");

  DepthRecord record(inputs(), reader.calibration(), estimator, frame_ == "raw-left");
  record.addSettings(binder.list());
  measureAll(reader, estimator, outputs, record);
  if (record.goodFrames() == 0 && !interrupted_)
    throw InputError(source_.left + ": not one frame could be measured; the reasons stand above");
  if (interrupted_) record.setInterrupted();
  const auto summary = paths_.applyTo(record.json());
  if (record.goodFrames() > 0) outputs.writeSummary(jsonText(summary));
  outputs.keep();
  if (!failure_.empty())
    throw BackendError(failure_ + ". What is finished stays; --backend cpu needs no GPU");
  if (common.json)
    printJson(summary);
  else
    printResult(summary, record.text(), outputs.told(record.goodFrames()), false);
  return interrupted_ ? kInterrupted : kDone;
}

/// As reconstruct does, where there is more than one pair and stereo measures the depth.
void DepthCommand::settleOffset(const SequencePaths& sequence, DepthOptions& options) {
  if (options.measurement.source != "stereo" && !sequence.depth.empty()) return;
  const std::string warning =
      settleRightOffset(sequence, options.sequence, options.measurement.stereo.disparity_max_px);
  if (!warning.empty()) spdlog::warn("{}", warning);
}

void DepthCommand::requireFreeOutputs(const DepthOutputs& outputs, const SequenceReader& reader) {
  if (fs::exists(out_) && !isFolder(out_))
    throw OptionError("--out " + out_ + ": is a file, but must be a folder, there or not yet");
  std::vector<std::string> prefixes;
  const FrameRange range = source_.frames.empty() ? FrameRange() : parseFrameRange(source_.frames);
  for (int i = 0; i < reader.frameCount(); ++i)
    prefixes.push_back(prefixOf(range.begin + i * range.step));
  outputs.requireFree(prefixes);
}

void DepthCommand::measureAll(SequenceReader& reader, DepthEstimator& estimator,
                              const DepthOutputs& outputs, DepthRecord& record) {
  ProgressBar progress("depth", reader.frameCount(),
                       is_sequence_ ? progressStyle(common.quiet) : ProgressBar::Style::kSilent,
                       std::cerr);
  while (const auto result = reader.next()) {
    if (interrupt_->requested()) {
      interrupted_ = true;
      spdlog::warn("interrupted: what is finished stays");
      break;
    }
    std::string error = result->error;
    if (result->ok()) try {
        measureOne(*result, estimator, outputs, record);
      } catch (const InputError& problem) {
        error = problem.what();
      } catch (const BackendError& problem) {
        failure_ = problem.what();
        interrupted_ = true;
        break;
      }
    if (!error.empty()) {
      failures_.add(result->unpaired ? "without a partner" : "not measured", result->index, error);
      record.addFailure(result->index, error);
    }
    progress.advance();
  }
  failures_.conclude("summary.json has each");
  warnings_.conclude("summary.json has each");
}

void DepthCommand::measureOne(const FrameResult& result, DepthEstimator& estimator,
                              const DepthOutputs& outputs, DepthRecord& record) {
  const DepthResult measured = estimator.measure(result.frame);
  if (!range_) range_ = rangeForAll(depthRangeToShow(measured.depth.depth_mm), is_sequence_);
  if (const std::string warning = rowWarning(measured); !warning.empty())
    warnings_.add("rows differ", result.index, warning);
  if (const std::string warning = coverageWarning(measured); !warning.empty()) {
    warnings_.add("little depth", result.index, warning);
    record.addWarning("frame " + std::to_string(result.index) + ": " + warning);
  }
  const auto start = std::chrono::steady_clock::now();
  outputs.write(prefixOf(result.index), measured, *range_,
                titleOf(measured.method, source_.left, is_sequence_ ? result.index : -1));
  const std::chrono::duration<double, std::milli> write = std::chrono::steady_clock::now() - start;
  record.addFrame(result.index, result.frame.time_s, measured, write.count());
}

std::string DepthCommand::prefixOf(int index) const {
  return is_sequence_ ? numberedName(index, "_") : "";
}

}  // namespace

std::unique_ptr<Command> makeDepthCommand() { return std::make_unique<DepthCommand>(); }

}  // namespace softscope
