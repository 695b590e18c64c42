// tests/pipeline/settings_test.cpp: one list of settings: each described once, checked by its key.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <type_traits>

#include "core/error.h"
#include "io/sequences/sequence_settings.h"
#include "io/settings/settings_text.h"
#include "pipeline/options/reconstruction_settings.h"
#include "pipeline/options/run_options.h"

namespace softscope::test {
namespace {

std::vector<SettingInfo> listOf(const std::string& preset = "default") {
  RunOptions options = RunOptions::ofPreset(preset);
  return settingsOf(options).list();
}

std::set<std::string> keys() {
  std::set<std::string> all;
  for (const SettingInfo& setting : listOf()) all.insert(setting.key);
  return all;
}

/// Complaint of validate(); empty without one.
std::string complaintOf(const RunOptions& options) {
  try {
    options.validate();
  } catch (const OptionError& error) {
    return error.what();
  }
  return {};
}

/// Converts to every type: for counting the fields of a struct.
struct AnyField {
  template <class T>
  operator T() const;
};

template <class T, class = void, class... Fields>
struct TakesFields : std::false_type {};
template <class T, class... Fields>
struct TakesFields<T, std::void_t<decltype(T{std::declval<Fields>()...})>, Fields...>
    : std::true_type {};

/// Fields of an aggregate; a nested struct counts as one.
template <class T, class... Fields>
constexpr int fieldCount() {
  if constexpr (TakesFields<T, void, Fields..., AnyField>::value)
    return fieldCount<T, Fields..., AnyField>();
  else
    return static_cast<int>(sizeof...(Fields));
}

struct Counter {
  int settings = 0;
  template <class... Arguments>
  void operator()(Arguments&&...) {
    ++settings;
  }
};

template <class Options>
int settingCount() {
  Options options;
  Counter counter;
  describe(counter, options);
  return counter.settings;
}

/// Sets the setting of one index to a value that its rule forbids.
struct Spoiler {
  int wanted = 0, index = 0;
  std::string key;

  bool isWanted(const char* name) {
    if (index++ != wanted) return false;
    key = name;
    return true;
  }
  void operator()(const char*, bool&, const char*) { ++index; }
  template <class Number>
  void operator()(const char* name, Number& field, const NumberRule& rule, const char*) {
    if (std::is_unsigned_v<Number>) {  // takes every value
      ++index;
      return;
    }
    if (!isWanted(name)) return;
    if (std::isfinite(rule.least))
      field = static_cast<Number>(rule.least_allowed ? rule.least - 1 : rule.least);
    else
      field = static_cast<Number>(rule.most_allowed ? rule.most + 1 : rule.most);
  }
  void operator()(const char* name, std::string& field, const TextRule&, const char*) {
    if (isWanted(name)) field = "nonsense";
  }
  void operator()(const char* name, std::string& field, const FreeText&, const char*) {
    if (isWanted(name)) field = "nonsense";
  }
  template <class Choice>
  void operator()(const char*, Choice&, const ChoiceRule<Choice>&, const char*) {
    ++index;  // an enumeration has no other values
  }
};

TEST(SettingsList, EveryKeyStandsOnceWithRangeAndMeaning) {
  const std::vector<SettingInfo> settings = listOf();
  EXPECT_EQ(keys().size(), settings.size());
  for (const SettingInfo& setting : settings) {
    EXPECT_FALSE(setting.range.empty()) << setting.key;
    EXPECT_FALSE(setting.help.empty()) << setting.key;
    EXPECT_EQ(setting.help.find_first_of("\n|"), std::string::npos) << setting.key;
  }
}

/// Settings of `Options` without those of the structs in it.
template <class Options, class... Nested>
int ownSettingCount() {
  return settingCount<Options>() - (0 + ... + settingCount<Nested>());
}

// The fields of a struct are its settings, the structs in it, and the
// number given second: fields set by code, or shared by several stages.
TEST(SettingsList, EveryFieldOfEveryStructIsDescribed) {
  EXPECT_EQ(fieldCount<ElasOptions>() - 2, settingCount<ElasOptions>());  // row meter, half
  EXPECT_EQ(fieldCount<RefinementOptions>() - 1, 0);                      // half size
  EXPECT_EQ(fieldCount<SmoothingOptions>() - 1, settingCount<SmoothingOptions>());  // by width
  EXPECT_EQ(fieldCount<StereoOptions>() - 3 - 1,                                    // half size
            (ownSettingCount<StereoOptions, ElasOptions, SmoothingOptions>()));
  EXPECT_EQ(fieldCount<SubpixelOptions>(), settingCount<SubpixelOptions>());
  EXPECT_EQ(fieldCount<MatcherOptions>() - 3, (ownSettingCount<MatcherOptions, SubpixelOptions>()));
  EXPECT_EQ(fieldCount<RansacOptions>(), settingCount<RansacOptions>());
  EXPECT_EQ(fieldCount<RefinePoseOptions>() - 1, settingCount<RefinePoseOptions>());  // tests
  EXPECT_EQ(fieldCount<GraphOptions>() - 1, settingCount<GraphOptions>());  // node spacing
  EXPECT_EQ(fieldCount<AssociationOptions>() - 1, settingCount<AssociationOptions>());  // tests
  EXPECT_EQ(fieldCount<DeformOptions>() - 2,
            (ownSettingCount<DeformOptions, AssociationOptions>()));
  EXPECT_EQ(fieldCount<PixelOptions>(), settingCount<PixelOptions>());
  EXPECT_EQ(fieldCount<PointFusionOptions>() - 2,  // node spacing, tests
            settingCount<PointFusionOptions>());
  EXPECT_EQ(fieldCount<ColourOptions>(), settingCount<ColourOptions>());
  EXPECT_EQ(fieldCount<InsertionOptions>() - 3, settingCount<InsertionOptions>());  // by frame
  EXPECT_EQ(fieldCount<CalibrationHints>(), settingCount<CalibrationHints>());
  EXPECT_EQ(fieldCount<SequenceOptions>() - 4,  // arguments: --frames, in pixels; frames read ahead
            (ownSettingCount<SequenceOptions, CalibrationHints>()));
  EXPECT_EQ(fieldCount<TissueMaskOptions>(), settingCount<TissueMaskOptions>());
  EXPECT_EQ(fieldCount<GateOptions>(), settingCount<GateOptions>());
}

// A value that a user cannot choose is a constant next to its formula.
TEST(SettingsList, HasAtMostSixtySettings) { EXPECT_LE(listOf().size(), 60U); }

TEST(SettingsList, OneQuantityHasOneSetting) {
  ReconstructionOptions options;
  options.fusion.insertion.spacing_mm = 0.3;
  options.graph.node_spacing_mm = 1.5;
  options = withSharedQuantities(options);
  EXPECT_EQ(options.model_view.point_spacing_mm, 0.3);
  EXPECT_EQ(options.fusion.density.cell_mm, 0.3);
  EXPECT_EQ(options.fusion.points.node_spacing_mm, 1.5);
  EXPECT_NO_THROW(options.graph.validate());
}

TEST(SettingsList, AValueOutOfItsRangeIsNamedByItsKey) {
  const int count = static_cast<int>(listOf().size());
  int spoilt = 0;
  for (int i = 0; i < count; ++i) {
    RunOptions options;
    Spoiler spoiler;
    spoiler.wanted = i;
    describe(spoiler, options.sequence);
    describe(spoiler, options.method);
    if (spoiler.key.empty()) continue;  // true/false and enumerations
    ++spoilt;
    EXPECT_EQ(complaintOf(options).find(spoiler.key + " is "), 0U)
        << spoiler.key << ": " << complaintOf(options);
  }
  EXPECT_GT(spoilt, 40);
}

// What one setting demands of another names keys too.
TEST(SettingsList, EveryNameInAMessageIsAKey) {
  const std::set<std::string> known = keys();
  const auto spoilt = [](const std::function<void(ReconstructionOptions&)>& spoil) {
    RunOptions options;
    spoil(options.method);
    return complaintOf(options);
  };
  for (const std::string& complaint : {spoilt([](auto& o) {
                                         o.depth.stereo.disparity_min_px = 300;
                                         o.depth.stereo.disparity_max_px = 255;
                                       }),
                                       spoilt([](auto& o) { o.deform.data_weight = -1; })}) {
    ASSERT_FALSE(complaint.empty());
    std::istringstream words(complaint);
    for (std::string word; words >> word;) {
      if (word.find('.') == std::string::npos || std::isalpha(word[0]) == 0) continue;
      EXPECT_EQ(known.count(word.substr(0, word.find_last_not_of(".,") + 1)), 1U) << complaint;
    }
  }
}

TEST(SettingsList, TheFileOfThePresetReadsBackToIt) {
  for (const std::string& preset : presetNames()) {
    const std::vector<SettingInfo> wanted = listOf(preset);
    RunOptions options;
    SettingsBinder binder = settingsOf(options);
    binder.apply(parseSettings(settingsToml(wanted), preset));
    const std::vector<SettingInfo> found = binder.list();
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i].current_text, wanted[i].current_text) << found[i].key;
    EXPECT_EQ(complaintOf(options), "");
  }
}

TEST(SettingsList, TheDocumentIsUpToDate) {
  std::ifstream file(SOFTSCOPE_DOCS "/settings.md", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), settingsDocument(listOf("default"), listOf("paper")))
      << "write it anew: softscope settings --markdown > docs/settings.md";
}

}  // namespace
}  // namespace softscope::test
