// tests/fuzz/settings_fuzz.cpp: settings files, assignments, frame ranges.
#include "fuzz/fuzz_target.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_settings.h"
#include "io/settings/settings.h"
#include "io/settings/settings_binder.h"

namespace softscope::test {
namespace {

SequenceOptions optionsOf(const Settings& settings) {
  SequenceOptions options;
  SettingsBinder binder;
  describe(binder, options);
  binder.apply(settings);
  options.validate();
  return options;
}

Settings assigned(std::string_view text) {
  Settings settings;
  addAssignment(settings, text);
  return settings;
}

}  // namespace
}  // namespace softscope::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const std::string_view text = textOf(data, size);
  const auto file = answerOf([&] { return parseSettings(text, "fuzz"); });
  const auto assignment = answerOf([&] { return assigned(text); });
  if (assignment) mustHold(assignment->size() == 1);
  for (const auto& settings : {file, assignment}) {
    if (!settings) continue;
    const auto options = answerOf([&] { return optionsOf(*settings); });
    if (options) mustHold(options->calibration.baseline_mm >= 0);
  }
  const auto range = answerOf([&] { return parseFrameRange(std::string(text)); });
  if (range) mustHold(range->begin >= 0 && (range->end < 0 || range->end > range->begin));
  return 0;
}
