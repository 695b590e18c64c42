// toolkit/depth/measure_sequence.cpp: loop over frames and collection of results.
#include "toolkit/depth/measure_sequence.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "io/files/folder.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "pipeline/backends.h"
#include "toolkit/depth/depth_estimator.h"
#include "toolkit/depth/depth_record.h"
#include "toolkit/depth/frame_statistics.h"
#include "toolkit/record/json_text.h"
#include "toolkit/run/out_folder.h"
#include "toolkit/run/repeated_warnings.h"
#include "toolkit/run/stereo_sync.h"
#include "toolkit/run/view_faults.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// One colour range for all images of a run: for a sequence that of the
/// first frame, extended by a tenth at each end because tissue moves.
DepthRange rangeForAll(const DepthRange& first, bool is_sequence) {
  if (!is_sequence) return first;
  const double margin_mm = std::ceil(0.1 * (first.farthest_mm - first.nearest_mm));
  return {std::max(0.0, first.nearest_mm - margin_mm), first.farthest_mm + margin_mm};
}

/// Title of the image: method, last part of the path, frame number unless negative.
std::string pictureTitle(const std::string& method, const std::string& path, int frame) {
  fs::path place = fs::path(path).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  std::string title = "Depth by " + method + ": " + place.filename().string();
  if (frame >= 0) title += ", frame " + std::to_string(frame);
  return title;
}

class SequenceMeasurement {
 public:
  SequenceMeasurement(MeasureOptions options, const WorkListener& listener)
      : options_(std::move(options)), listener_(listener) {}

  MeasuredSequence measure();

 private:
  ViewRelation relateViews();
  void requireFree(const DepthOutputs& outputs, int frames) const;
  DepthEstimator estimatorFor(const SequenceReader& reader) const;
  void measureAll(SequenceReader& reader, DepthEstimator& estimator, const DepthOutputs& outputs,
                  DepthRecord& record);
  void measureOne(const FrameResult& result, const StereoCalibration& calibration,
                  DepthEstimator& estimator, const DepthOutputs& outputs, DepthRecord& record);
  std::string faultsOf(const FrameResult& result, const StereoCalibration& calibration) const;
  std::string prefixOf(int index) const {
    return options_.numbered ? numberedName(index, "_") : "";
  }

  MeasureOptions options_;
  const WorkListener& listener_;
  RepeatedWarnings failures_{[this](const std::string& text) { listener_.fail(text); }};
  RepeatedWarnings warnings_{[this](const std::string& text) { listener_.warn(text); }};
  bool interrupted_ = false;
  std::string failure_;  // failure of the back end during the sequence
};

/// As in reconstruct, for more than one pair with stereo depth.
ViewRelation SequenceMeasurement::relateViews() {
  DepthOptions& settings = options_.settings;
  ViewRelation views =
      softscope::relateViews(options_.sequence, settings.measurement, settings.sequence);
  for (const std::string& warning : views.warnings) listener_.warn(warning);
  return views;
}

void SequenceMeasurement::requireFree(const DepthOutputs& outputs, int frames) const {
  if (fs::exists(options_.out) && !isFolder(options_.out))
    throw OptionError("`out=` " + shown(options_.out) +
                      ": is a file, but must be a new or existing folder");
  std::vector<std::string> prefixes;
  const FrameRange& range = options_.settings.sequence.frames;
  for (int i = 0; i < frames; ++i) prefixes.push_back(prefixOf(range.begin + i * range.step));
  outputs.requireFree(prefixes);
}

DepthEstimator SequenceMeasurement::estimatorFor(const SequenceReader& reader) const {
  // The start of a GPU takes longer than one pair on the CPU.
  const bool one_pair = options_.backend == "auto" && reader.frameCount() == 1;
  auto chosen = makeFrameDepth(one_pair ? "cpu" : options_.backend, reader.calibration(),
                               options_.settings.measurement);
  if (!chosen.why.empty()) listener_.tell("back end: " + chosen.name + " (" + chosen.why + ")");
  return DepthEstimator(std::move(chosen.part), chosen.name, options_.raw_left);
}

MeasuredSequence SequenceMeasurement::measure() {
  options_.settings.validate();
  options_.settings.sequence.uncalibrated = options_.uncalibrated();
  const ViewRelation views = relateViews();
  SequenceReader reader(options_.sequence, options_.settings.sequence);
  reader.expectRows(views.rows);
  for (const std::string& warning : reader.calibration().warnings) listener_.warn(warning);
  options_.numbered = options_.numbered || reader.totalCount() > 1;
  DepthOutputKinds kinds = options_.kinds            ? *options_.kinds
                           : reader.frameCount() > 1 ? DepthOutputKinds::ofSequence()
                                                     : DepthOutputKinds();
  kinds.dense = kinds.dense || options_.dense;
  const DepthOutputs outputs({options_.out, kinds, options_.overwrite, options_.raw_left});
  requireApart(options_.out, options_.sequence);
  requireFree(outputs, reader.frameCount());
  DepthEstimator estimator = estimatorFor(reader);
  if (const std::string& model = options_.settings.measurement.stereo.model; !model.empty())
    options_.inputs["stereo_model"] = model;

  DepthRecord record(options_.inputs, reader.calibration(), estimator, options_.raw_left);
  for (const std::string& warning : views.warnings) record.addWarning(warning);
  record.addSettings(settingsOf(options_.settings).list());
  measureAll(reader, estimator, outputs, record);
  if (record.goodFrames() == 0 && !interrupted_)
    throw InputError(options_.name +
                     ": no frame could be measured, so nothing was written; the "
                     "errors name the frames and the reasons");
  if (interrupted_) record.setInterrupted();
  MeasuredSequence measured{options_.paths.applyTo(record.json()), record.text(),
                            outputs.writtenFiles(record.goodFrames()), interrupted_};
  if (record.goodFrames() > 0) outputs.writeSummary(jsonText(measured.record));
  outputs.keep();
  if (!failure_.empty())
    throw BackendError(failure_ + ". Finished results are kept; `backend=` cpu needs no GPU");
  return measured;
}

void SequenceMeasurement::measureAll(SequenceReader& reader, DepthEstimator& estimator,
                                     const DepthOutputs& outputs, DepthRecord& record) {
  const int count = reader.frameCount();
  interrupted_ = !reportProgress(listener_.progress, 0, count);
  int done = 0;
  while (!interrupted_) {
    const auto result = reader.next();
    if (!result) break;
    std::string error = result->error;
    if (result->ok()) try {
        measureOne(*result, reader.calibration(), estimator, outputs, record);
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
    interrupted_ = !reportProgress(listener_.progress, ++done, count) && done < count;
  }
  if (interrupted_ && failure_.empty()) listener_.warn("interrupted: finished results are kept");
  const char* where = record.goodFrames() > 0 ? "details: summary.json" : "";
  failures_.conclude(where);
  warnings_.conclude(where);
}

std::string SequenceMeasurement::faultsOf(const FrameResult& result,
                                          const StereoCalibration& calibration) const {
  const bool right_first = options_.settings.sequence.right_first;
  return viewFaults(result.frame, result.names, {calibration, options_.sequence, right_first});
}

void SequenceMeasurement::measureOne(const FrameResult& result,
                                     const StereoCalibration& calibration,
                                     DepthEstimator& estimator, const DepthOutputs& outputs,
                                     DepthRecord& record) {
  const DepthResult measured = estimator.measure(result.frame);
  if (!options_.range)
    options_.range = rangeForAll(depthRangeToShow(measured.depth.depth_mm), options_.numbered);
  if (const std::string warning = rowWarning(measured); !warning.empty())
    warnings_.add("rows differ", result.index, warning);
  const FrameCoverage coverage = coverageOf(measured);
  const std::string causes = hasLittleDepth(coverage) ? faultsOf(result, calibration) : "";
  if (const std::string warning = coverageWarning(coverage, causes); !warning.empty()) {
    warnings_.add("little depth", result.index, warning);
    record.addWarning("frame " + std::to_string(result.index) + ": " + warning);
  }
  const auto start = std::chrono::steady_clock::now();
  outputs.write(
      prefixOf(result.index), measured, *options_.range,
      pictureTitle(measured.method, options_.name, options_.numbered ? result.index : -1));
  const std::chrono::duration<double, std::milli> write = std::chrono::steady_clock::now() - start;
  record.addFrame(result.index, result.frame.time_s, measured, write.count());
}

}  // namespace

DepthRange parseDepthRange(const std::string& text) {
  const auto colon = text.find(':');
  const auto low = numberOf(text.substr(0, colon));
  const auto high = colon == std::string::npos ? std::nullopt : numberOf(text.substr(colon + 1));
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high) || *low >= *high)
    throw OptionError("`range=` is `" + text +
                      "`, but must be two rising numbers in mm, e.g. 40:80");
  return {*low, *high};
}

MeasuredSequence measureSequence(MeasureOptions options, const WorkListener& listener) {
  return SequenceMeasurement(std::move(options), listener).measure();
}

}  // namespace softscope
