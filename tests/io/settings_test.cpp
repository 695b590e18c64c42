#include "io/settings/settings.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/nearest_name.h"
#include "io/settings/settings_binder.h"
#include "io/settings/settings_text.h"
#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

enum class Loss { kNone, kHuber };

struct Options {
  bool fill = true;
  int step_px = 5;
  double weight = 1.5;
  std::string method = "elas";
  Loss loss = Loss::kNone;
};

template <class Visitor>
void describe(Visitor& v, Options& o) {
  v("stereo.fill", o.fill, "close gaps");
  v("stereo.step_px", o.step_px, between(1, 9), "grid");
  v("deform.weight", o.weight, above(0), "rigidity");
  v("stereo.method", o.method, FreeText{"a method"}, "of stereo");
  v("stereo.loss", o.loss, ChoiceRule<Loss>{{{"none", Loss::kNone}, {"huber", Loss::kHuber}}},
    "robust");
}

SettingsBinder binderOf(Options& options) {
  SettingsBinder binder;
  describe(binder, options);
  return binder;
}

TEST(Settings, TablesAndDottedKeysAreTheSame) {
  const Settings settings = parseSettings(
      "deform.weight = 2\n[stereo]\nfill = false\nstep_px = 7\nmethod = 'sgbm'\n", "s.toml");
  Options options;
  binderOf(options).apply(settings);
  EXPECT_FALSE(options.fill);
  EXPECT_EQ(options.step_px, 7);
  EXPECT_EQ(options.weight, 2.0);  // a whole number is a number
  EXPECT_EQ(options.method, "sgbm");
  EXPECT_EQ(settings.at("stereo.step_px").origin, "s.toml:4");
}

TEST(Settings, KeysAndBracketsNestOnlySoDeep) {
  std::string key;
  for (int i = 0; i < 20000; ++i) key += "a.";
  const std::string brackets(20000, '[');
  expectError<InputError>([&] { parseSettings("x = 1\n" + key + "b = 1", "s.toml"); },
                          {"s.toml:2"});
  expectError<InputError>([&] { parseSettings("[" + key + "b]", "s.toml"); }, {"s.toml:1"});
  expectError<InputError>([&] { parseSettings("x = " + brackets, "s.toml"); }, {"s.toml:1"});
  Settings settings;
  expectError<InputError>([&] { addAssignment(settings, "x=" + brackets); }, {"`set=` x"});
  const std::string dots(200, '.');
  EXPECT_EQ(parseSettings("x = \"" + dots + "\\\"" + dots + "\" # " + dots + "\ny = '" + dots + "'",
                          "s.toml")
                .size(),
            2U)
      << "dots of texts and comments are no parts of a key";
}

TEST(Settings, AssignmentsWinAndNeedNoQuotes) {
  Settings settings = parseSettings("stereo.method = 'elas'\n", "s");
  addAssignment(settings, "stereo.method=sgbm");
  addAssignment(settings, " deform.weight = 2.5 ");
  addAssignment(settings, "stereo.fill=false");
  Options options;
  binderOf(options).apply(settings);
  EXPECT_EQ(options.method, "sgbm");
  EXPECT_EQ(options.weight, 2.5);
  EXPECT_FALSE(options.fill);
  addAssignment(settings, "stereo.method=5");
  binderOf(options).apply(settings);
  EXPECT_EQ(options.method, "5");
  expectError<OptionError>([&] { addAssignment(settings, "fill"); }, {"fill", "key=value"});
  expectError<OptionError>([&] { addAssignment(settings, "=3"); }, {"key=value"});
}

// As everywhere else (docs/formats.md), though TOML has no such numbers.
TEST(Settings, AssignedNumbersNeedNoDigitBesideThePoint) {
  for (const auto& [text, number] : {std::pair(".5", 0.5), {"5.", 5.0}, {"+.25", 0.25}}) {
    Settings settings;
    addAssignment(settings, std::string("deform.weight=") + text);
    Options options;
    binderOf(options).apply(settings);
    EXPECT_EQ(options.weight, number) << text;
  }
  Settings settings;
  addAssignment(settings, "stereo.method=.5");
  Options options;
  binderOf(options).apply(settings);
  EXPECT_EQ(options.method, ".5");
}

TEST(Settings, AnUnknownKeyGetsTheNearestName) {
  Options options;
  const SettingsBinder binder = binderOf(options);
  const auto apply = [&](const std::string& toml) {
    return [&binder, toml] { SettingsBinder(binder).apply(parseSettings(toml, "s.toml")); };
  };
  expectError<OptionError>(apply("\nstereo.stepp_px = 3"),
                           {"s.toml:2", "`stereo.stepp_px`", "Did you mean stereo.step_px?"});
  expectError<OptionError>(apply("weight = 3"), {"Did you mean deform.weight?"});
  expectError<OptionError>(apply("camera.brightness = 3"), {"`softscope settings COMMAND`"});
}

TEST(Settings, TypesAreCheckedAndNothingIsSetByHalves) {
  Options options;
  SettingsBinder binder = binderOf(options);
  const auto expectType = [&](const std::string& toml, const std::vector<std::string>& parts) {
    expectError<OptionError>([&] { binder.apply(parseSettings(toml, "s.toml")); }, parts);
  };
  expectType("stereo.step_px = 2.5", {"s.toml:1", "stereo.step_px", "`2.5`", "whole number"});
  expectType("stereo.step_px = 99999999999", {"whole number"});
  expectType("stereo.fill = 1", {"true or false"});
  expectType("stereo.method = 3", {"text in quotes"});
  expectType("stereo.method = \"one\\ntwo\"", {"`one?two`", "one line"});
  expectType("deform.weight = 'much'", {"`much`", "a number"});
  expectType("deform.weight = nan", {"a number"});
  expectType("deform.weight = 9\nstereo.fill = 1", {"true or false"});
  EXPECT_EQ(options.weight, 1.5);
}

TEST(Settings, BrokenFilesNameTheLine) {
  expectError<InputError>([] { parseSettings("a = 1\nb = = 2\n", "s.toml"); },
                          {"s.toml:2", "TOML"});
  expectError<OptionError>([] { parseSettings("a = [1, 2]\n", "s.toml"); },
                           {"s.toml:1", "`a`", "list"});
  expectError<InputError>([] { parseSettings("[stereo]\nstep_px = 1\nstep_px = 2\n", "s.toml"); },
                          {"s.toml:3", "redefine", "step_px"});
  expectError<InputError>([] { readSettings("/no/such.toml"); }, {"no such file"});
}

TEST(Settings, ListShowsDefaultsAndWhatIsSet) {
  Options options;
  SettingsBinder binder = binderOf(options);
  Settings settings;
  addAssignment(settings, "deform.weight=0.1");
  binder.apply(settings);
  const auto list = binder.list();
  ASSERT_EQ(list.size(), 5U);
  EXPECT_EQ(list[0].key, "stereo.fill");
  EXPECT_EQ(list[0].type, "true/false");
  EXPECT_EQ(list[2].default_text, "1.5");
  EXPECT_EQ(list[2].current_text, "0.1");
  EXPECT_EQ(list[2].help, "rigidity");
  EXPECT_EQ(list[1].range, "1 to 9");
  EXPECT_EQ(list[1].unit, "px");
  EXPECT_EQ(list[4].range, "none or huber");
  expectError<Error>([&] { binder("stereo.fill", options.fill, ""); }, {"twice"});
}

TEST(Settings, RangesAreCheckedAndNamed) {
  Options options;
  SettingsBinder binder = binderOf(options);
  const auto expectRange = [&](const std::string& toml, const std::vector<std::string>& parts) {
    expectError<OptionError>([&] { binder.apply(parseSettings(toml, "s.toml")); }, parts);
  };
  expectRange("stereo.step_px = 10", {"s.toml:1: stereo.step_px is 10, expected 1 to 9"});
  expectRange("deform.weight = 0", {"s.toml:1: deform.weight is 0, expected above 0"});
  expectRange("stereo.loss = 'tukey'", {"s.toml:1: stereo.loss is tukey, expected none or huber"});
  expectRange("stereo.step_px = 2\ndeform.weight = -1", {"s.toml:2"});
  EXPECT_EQ(options.step_px, 5);
  binder.apply(parseSettings("stereo.loss = 'huber'", "s.toml"));
  EXPECT_EQ(options.loss, Loss::kHuber);
}

TEST(Settings, TheFileOfAListReadsBack) {
  Options options;
  options.method = "a \"quoted\" \\ text";
  options.weight = 1e-7;
  options.loss = Loss::kHuber;
  const std::string toml = settingsToml(binderOf(options).list());
  Options again;
  binderOf(again).apply(parseSettings(toml, "s.toml"));
  EXPECT_EQ(again.method, options.method);
  EXPECT_EQ(again.weight, options.weight);
  EXPECT_EQ(again.loss, options.loss);
  EXPECT_NE(toml.find("# grid: 1 to 9 px\nstereo.step_px = 5\n"), std::string::npos) << toml;
}

TEST(NearestName, CountsEditsAndSwaps) {
  EXPECT_EQ(editDistance("kitten", "sitting"), 3);
  EXPECT_EQ(editDistance("", "abc"), 3);
  EXPECT_EQ(editDistance("wieght", "weight"), 1);  // one swap
  EXPECT_EQ(nearestName("Method", {"stereo.method", "stereo.mode"}), "stereo.method");
  EXPECT_EQ(nearestName("zzzzzz", {"stereo.method"}), "");
  EXPECT_EQ(nearestName(std::string(100000, 'a'), {"a"}), "");
}

}  // namespace
}  // namespace softscope::test
