// toolkit/study/study_settings.cpp: options as arguments, settings as --set.
#include "toolkit/study/study_settings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/nearest_name.h"
#include "io/sequences/sequence_options.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "pipeline/options/run_options.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kReconstructOptions{"preset", "backend",     "frames", "save_every",
                                                   "right",  "calibration", "mask"};
const std::vector<std::string> kEvaluateOptions{"reference", "align"};

bool isOption(const std::string& key, const std::vector<std::string>& options) {
  return std::find(options.begin(), options.end(), key) != options.end();
}

std::string flagOf(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

void addWord(std::vector<std::string>& words, const std::string& flag, const std::string& value) {
  words.push_back(flag);
  words.push_back(value);
}

Settings settingsOf(const StudyCase& study_case, const StudyValues& values,
                    const std::vector<std::string>& options) {
  Settings settings;
  for (const auto& [key, value] : values) {
    if (isOption(key, options)) continue;
    addAssignment(settings, key + "=" + value);
    settings[key].origin = "case " + study_case.name;
  }
  return settings;
}

std::string lines(const SettingsBinder& binder) {
  std::string text;
  for (const SettingInfo& setting : binder.list())
    text += setting.key + "=" + setting.current_text + "\n";
  return text;
}

std::string valueOr(const StudyValues& values, const std::string& key, const std::string& other) {
  const auto found = values.find(key);
  return found == values.end() ? other : found->second;
}

void requireOneOf(const StudyCase& study_case, const std::string& key, const std::string& value,
                  const std::vector<std::string>& known) {
  if (isOption(value, known)) return;
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  const std::string nearest = nearestName(value, known);
  throw OptionError("case " + study_case.name + ": " + key + " is " + excerpt(value) +
                    ", but must be one of " + list +
                    (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)"));
}

/// Checks values in advance that `reconstruct` would refuse later.
void checkReconstructValues(const StudyCase& study_case) {
  const StudyValues& values = study_case.reconstruct;
  requireOneOf(study_case, "reconstruct.backend", valueOr(values, "backend", "auto"),
               {"auto", "cpu", "cuda"});
  requireOneOf(study_case, "reconstruct.preset", valueOr(values, "preset", "default"),
               presetNames());
  const std::string save_every = valueOr(values, "save_every", "5");
  const auto number = numberOf(save_every);
  if (!number || *number < 0 || *number > 1e9 || *number != std::floor(*number))
    throw OptionError("case " + study_case.name + ": reconstruct.save_every is " +
                      excerpt(save_every) + ", but must be a whole number, 0 or more");
  const std::string frames = valueOr(values, "frames", "");
  try {
    if (!frames.empty()) parseFrameRange(frames);
  } catch (const OptionError& error) {
    throw OptionError("case " + study_case.name + ": reconstruct.frames: " + error.what());
  }
}

}  // namespace

std::vector<std::string> simulateWords(const StudyCase& study_case, const std::string& folder) {
  std::vector<std::string> words{"simulate"};
  for (const auto& [key, value] : study_case.simulate)
    if (key == "scenario")
      addWord(words, "--scenario", value);
    else
      addWord(words, "--set", key + "=" + value);
  addWord(words, "--out", folder);
  return words;
}

std::vector<std::string> reconstructWords(const StudyCase& study_case, const std::string& sequence,
                                          const std::string& run) {
  std::vector<std::string> words{"reconstruct", sequence};
  if (const std::string right = valueOr(study_case.reconstruct, "right", ""); !right.empty())
    words.push_back(right);
  if (study_case.reconstruct.count("save_every") == 0) addWord(words, "--save-every", "5");
  for (const auto& [key, value] : study_case.reconstruct)
    if (isOption(key, kReconstructOptions) && key != "right")
      addWord(words, flagOf(key), value);
    else if (key != "right")
      addWord(words, "--set", key + "=" + value);
  const fs::path tracks = fs::path(sequence) / "track_points.csv";
  if (fs::exists(tracks)) addWord(words, "--track", tracks.string());
  addWord(words, "--out", run);
  words.emplace_back("--force");
  return words;
}

std::vector<std::string> evaluateWords(const StudyCase& study_case, const std::string& run,
                                       const std::string& reference, const std::string& out) {
  std::vector<std::string> words{"evaluate", run};
  for (const auto& [key, value] : study_case.evaluate)
    if (key != "reference") addWord(words, flagOf(key), value);
  addWord(words, "--reference", reference);
  addWord(words, "--out", out);
  words.emplace_back("--force");
  return words;
}

std::string simulationText(const StudyCase& study_case) {
  StudyValues values = study_case.simulate;
  Settings settings;
  if (const std::string scenario = valueOr(values, "scenario", ""); !scenario.empty())
    settings = readSettings(scenario);
  values.erase("scenario");
  for (auto& [key, setting] : settingsOf(study_case, values, {})) settings[key] = setting;
  SimulateOptions options;
  SettingsBinder binder = settingsOf(options);
  binder.apply(settings);
  options.validate();
  return lines(binder);
}

std::string reconstructionText(const StudyCase& study_case) {
  const StudyValues& values = study_case.reconstruct;
  checkReconstructValues(study_case);
  const std::string preset = valueOr(values, "preset", "default");
  RunOptions options = RunOptions::ofPreset(preset);
  SettingsBinder binder = settingsOf(options);
  binder.apply(settingsOf(study_case, values, kReconstructOptions));
  options.validate();
  return "preset=" + preset + "\nframes=" + valueOr(values, "frames", "") +
         "\nsave_every=" + valueOr(values, "save_every", "5") +
         "\nbackend=" + valueOr(values, "backend", "auto") + "\n" + lines(binder);
}

std::string evaluationText(const StudyCase& study_case) {
  const std::string align = valueOr(study_case.evaluate, "align", "none");
  requireOneOf(study_case, "evaluate.align", align, {"none", "rigid", "icp"});
  const std::string reference = valueOr(study_case.evaluate, "reference", "");
  if (align != "none" && (reference.empty() || fs::is_directory(reference)))
    throw OptionError("case " + study_case.name +
                      ": evaluate.align is for a mesh; name one as evaluate.reference");
  std::string text;
  for (const auto& [key, value] : study_case.evaluate) {
    if (!isOption(key, kEvaluateOptions)) {
      const std::string nearest = nearestName(key, kEvaluateOptions);
      throw OptionError(say("case ", study_case.name, ": evaluate.", key, " is no such key",
                            nearest.empty() ? "" : " (did you mean `evaluate." + nearest + "`?)",
                            "; there are evaluate.reference and evaluate.align"));
    }
    text += key + "=" + value + "\n";
  }
  return text;
}

}  // namespace softscope
