// toolkit/figures/figure_matches.cpp: the loop's stages 1 to 4 for one frame, twice.
#include "toolkit/figures/figure_matches.h"

#include <algorithm>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/sequences/sequence_paths.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "pipeline/frame/model_matches.h"
#include "pipeline/frame/pose_pairs.h"
#include "pipeline/options/run_options.h"
#include "pose/ransac_pose.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/run_reader.h"
#include "vtk_views/plots/match_figure.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

constexpr std::uintmax_t kRecordLimitBytes = std::uintmax_t{1} << 26;

/// As the run was told, from its run.json.
RunOptions optionsOf(const fs::path& run) {
  const fs::path file = run / "run.json";
  const Json record = Json::parse(readBytes(file, kRecordLimitBytes), nullptr, false);
  if (!record.is_object() || !record.contains("configuration"))
    throw InputError(shown(file) + ": has no settings of the run; reconstruct again");
  Settings settings;
  for (const auto& [key, value] : record["configuration"].items()) {
    if (!value.is_string()) addAssignment(settings, key + "=" + value.dump());
    Setting& setting = settings[key];
    if (value.is_string()) setting.value = setting.text = value.get<std::string>();
    setting.origin = shown(file);
  }
  RunOptions options;
  try {
    settingsOf(options).apply(settings);
    options.validate();
  } catch (const OptionError& error) {
    throw InputError(shown(file) + ": was written by another version (" + error.what() +
                     "); reconstruct again");
  }
  options.method = withSharedQuantities(options.method);
  return options;
}

/// The frame to look at, and the saved model to seek in it.
struct MatchMoment {
  int frame = 0, model_frame = 0;
  Eigen::Isometry3d viewed_from = Eigen::Isometry3d::Identity();  // world_from_left before it
};

MatchMoment momentOf(const JudgedRun& run, const std::vector<int>& wanted) {
  if (run.models.empty())
    throw InputError(shown(run.folder) +
                     ": has no models of single frames; reconstruct with `save_every=` 1");
  MatchMoment moment;
  if (wanted.empty()) {
    for (const auto& [frame, file] : run.models) {
      const auto next = std::upper_bound(run.frames.begin(), run.frames.end(), frame);
      if (next != run.frames.end()) moment.frame = *next;
    }
  } else {
    moment.frame = wanted[0];
  }
  const auto after = run.models.lower_bound(moment.frame);
  if (after == run.models.begin() ||
      !std::binary_search(run.frames.begin(), run.frames.end(), moment.frame))
    throw OptionError(say("`frame=` is ", moment.frame, ", but must be one of the run's, after ",
                          run.models.begin()->first, ", whose model is the first saved one"));
  moment.model_frame = std::prev(after)->first;
  const auto before = std::lower_bound(run.frames.begin(), run.frames.end(), moment.frame) - 1;
  moment.viewed_from =
      run.trajectory[static_cast<std::size_t>(before - run.frames.begin())].world_from_left;
  return moment;
}

Frame readFrame(const std::string& sequence, int frame, SequenceOptions options,
                SceneInputs& inputs, StereoCalibration* calibration) {
  options.frames = {frame, frame + 1};
  const SequencePaths paths = findSequence(sequence);
  for (const fs::path& part : {paths.left, paths.right, paths.stereo})
    if (!part.empty()) inputs.note("pictures", part.string());
  SequenceReader reader(paths, options);
  *calibration = reader.calibration();
  auto result = reader.next();
  if (!result || !result->ok())
    throw InputError(say(sequence, ": frame ", frame,
                         " can't be used: ", result ? result->error : "the sequence is shorter"));
  return std::move(result->frame);
}

/// One matcher's answer.
struct Answer {
  MatchPanel panel;
  Json json;
};

Answer answerOf(const char* method, const char* name, const ModelView& view,
                const MatchPicture& live, const MeasuredFrame& measured,
                const ReconstructionOptions& options) {
  MatcherOptions matcher = options.matcher;
  matcher.method = method;
  const ModelMatches found =
      matchModel(view, modelPicture(view), live, measured, *makeFeatureMatcher(matcher));
  const RigidPose pose = estimateRigidPose(posePairs(found.lifted), options.pose);
  Answer answer;
  for (std::size_t i = 0; i < found.lifted.size(); ++i) {
    const PixelMatch& match = found.pixels[static_cast<std::size_t>(found.lifted[i].match)];
    answer.panel.matches.push_back({match.model_px, match.live_px, pose.inlier[i] != 0});
  }
  const std::size_t count = found.lifted.size();
  answer.panel.caption = std::string(name) + ": " + std::to_string(count) +
                         " matches with depth, " +
                         (pose.found ? fixed(100.0 * pose.inliers / double(count), 1) + " % inliers"
                                     : "no rigid pose");
  answer.json = {{"matcher", method},
                 {"matches", found.pixels.size()},
                 {"with_depth", count},
                 {"inliers", pose.inliers},
                 {"pose_found", pose.found}};
  return answer;
}

}  // namespace

RunFigure drawMatchFigure(const RunFigureOptions& options, SceneInputs& inputs) {
  const JudgedRun run = openJudgedRun(options.run);
  const MatchMoment moment = momentOf(run, options.frames);
  const RunOptions settings = optionsOf(run.folder);
  StereoCalibration calibration;
  const Frame frame =
      readFrame(options.sequence, moment.frame, settings.sequence, inputs, &calibration);
  FrameDepth depth(calibration, settings.method.depth);
  const MeasuredFrame measured = depth.measure(frame);
  const MatchPicture live = livePicture(measured.left, toGray(measured.left),
                                        notTissue(measured.left, measured, settings.method.tissue));
  const fs::path file = run.models.at(moment.model_frame);
  inputs.note("model", file.string());
  const ModelView view = renderModelView(readModel(file).model, depth.rig().left,
                                         moment.viewed_from, settings.method.model_view);
  MatchFigure figure;
  figure.left = view.colour;
  figure.right = measured.left;
  figure.left_title = "model view";
  figure.right_title = say("left image, frame ", moment.frame);
  RunFigure result;
  result.record = {{"run", options.run},
                   {"sequence", options.sequence},
                   {"frame", moment.frame},
                   {"model_frame", moment.model_frame},
                   {"inlier_threshold_mm", settings.method.pose.threshold_mm}};
  for (const auto& [method, name] :
       {std::pair{MatcherOptions::kDenseSurf, "dense SURF"}, {MatcherOptions::kSift, "SIFT"}}) {
    Answer answer = answerOf(method, name, view, live, measured, settings.method);
    figure.panels.push_back(std::move(answer.panel));
    result.record["matchers"].push_back(std::move(answer.json));
  }
  figure.note = say("Model of frame ", moment.model_frame, ". Inliers: within ",
                    settings.method.pose.threshold_mm,
                    " mm of one rigid motion. Dots: all matches; lines: some of them, inliers and "
                    "outliers in true proportion. Research use only.");
  result.drawing = drawMatches(figure, options.panels.style);
  return result;
}

}  // namespace softscope
