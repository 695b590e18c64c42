#include "io/documents/document.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/error.h"
#include "io/documents/number_tree.h"
#include "io/geometry/track_points_file.h"
#include "io/geometry/trajectory_file.h"
#include "io/sequences/timestamps_file.h"
#include "io/settings/settings.h"
#include "io/temporary_folder.h"
#include "io/text/text_lines.h"

namespace softscope::test {
namespace {

TEST(Yaml, ReadsBlocksFlowsAndComments) {
  const Document d = parseYaml(
      "# head\n%YAML:1.0\n---\na: 1 # one\nb:\n  c: 'x # y'\n  d: [1, 2,\n      3]\ne: {f: 4, g: "
      "[5]}\n"
      "list:\n- 6\n-\n  h: 7\n- - 8\n  - 9\n",
      "t");
  EXPECT_EQ(d.find("a")->text, "1");
  EXPECT_EQ(d.find("b")->find("c")->text, "x # y");
  EXPECT_EQ(numbersOf(*d.find("b")->find("d"), "d"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(d.find("e")->find("f")->text, "4");
  ASSERT_EQ(d.find("list")->items.size(), 3U);
  EXPECT_EQ(d.find("list")->items[1].find("h")->text, "7");
  EXPECT_EQ(numbersOf(d.find("list")->items[2], "l"), (std::vector<double>{8, 9}));
  EXPECT_EQ(d.find("none"), nullptr);
}

TEST(Yaml, NamesTheLineThatItCannotRead) {
  expectError<InputError>([] { parseYaml("a: 1\n  b: 2\n", "t.yaml"); }, {"t.yaml: line 2"});
  expectError<InputError>([] { parseYaml("a: [1, 2\nb: 3\n", "t"); }, {"t: line 1"});
  expectError<InputError>([] { parseYaml("a: 1\nnothing\n", "t"); }, {"line 2", "nothing"});
  expectError<InputError>([] { parseYaml("# only\n", "t"); }, {"no data"});
  expectError<InputError>([] { parseYaml("a: " + std::string(1000, '['), "t"); }, {"nested"});
  expectError<InputError>(
      [] {
        std::string deep;
        for (int i = 0; i < 1000; ++i) deep += "- ";
        parseYaml(deep + "x", "t");
      },
      {"nested"});
}

TEST(Documents, AKeyHasOneValue) {
  const auto expectRefused = [](const char* text) {
    expectError<InputError>([&] { parseDocument(text, "c"); }, {"c: `M1`", "twice"});
  };
  expectRefused("M1: 1\nR: 2\nM1: 3\n");
  expectRefused("a:\n  M1: 1\n  M1: [1]\n");
  expectRefused("a: {M1: 1, M1: 2}\n");
  expectRefused("<r><M1>1</M1><M1>2</M1></r>");
  expectRefused(R"({"a": [{"M1": [1, 2], "M1": [1, 3]}]})");
  EXPECT_EQ(parseDocument(R"({"M1": [1, 2.5], "M1": [1, 2.5]})", "c").members.size(), 2U);
  EXPECT_EQ(parseDocument("M1: 1\nM1: 1\n", "c").find("M1")->text, "1");
}

TEST(Texts, AreReadWithTheByteOrderMarkOfUtf8) {
  TemporaryFolder folder;
  const auto marked = [&](const char* name, const std::string& text) {
    put(folder / name, "\xef\xbb\xbf" + text);
    return folder / name;
  };
  EXPECT_EQ(readTimestamps(marked("t.txt", "0.5\n1\n")), (std::vector<double>{0.5, 1}));
  EXPECT_EQ(readTrackPixels(marked("t.csv", "id,u_px,v_px\n7,1,2\n"))[0].id, 7);
  EXPECT_EQ(readTrajectory(marked("p.txt", "0 1 2 3 0 0 0 1\n")).size(), 1U);
  EXPECT_EQ(readSettings(marked("s.toml", "stereo.method = 'elas'\n")).count("stereo.method"), 1U);
  put(folder / "big.txt", std::string("\xfe\xff\0", 3) + "1");
  expectError<InputError>([&] { readTimestamps(folder / "big.txt"); }, {"big.txt", "UTF-16"});
}

TEST(Json, KeepsOrderTextsAndBounds) {
  const Document d = parseJson(R"({"b": {"x": [1, -2.5, true, null]}, "a": "t"})", "j");
  EXPECT_EQ(d.members[0].first, "b");
  const Document& x = *d.find("b")->find("x");
  ASSERT_EQ(x.items.size(), 4U);
  EXPECT_EQ(x.items[1].text, "-2.5");
  EXPECT_EQ(x.items[2].text, "true");
  EXPECT_EQ(x.items[3].text, "");
  EXPECT_EQ(d.find("a")->text, "t");
  expectError<InputError>([] { parseJson(R"({"a": 1e999})", "j"); }, {"beyond all bounds"});
  expectError<InputError>([] { parseJson(R"({"a": )", "j"); }, {"not valid JSON"});
  expectError<InputError>([] { parseJson(std::string(100, '['), "j"); }, {"nested"});
}

TEST(Xml, ReadsElementsAndLists) {
  const Document d = parseXml(
      "<?xml version='1.0'?><!-- c --><root a='1'><x> 1 2 </x><y><_>3</_><_>4</_></y><z/></root>",
      "t");
  EXPECT_EQ(numbersOf(*d.find("x"), "x"), (std::vector<double>{1, 2}));
  EXPECT_EQ(numbersOf(*d.find("y"), "y"), (std::vector<double>{3, 4}));
  EXPECT_EQ(d.find("z")->text, "");
}

TEST(Xml, NamesTheLineThatItCannotRead) {
  expectError<InputError>([] { parseXml("<a>\n<b>\n</a>", "t.xml"); }, {"t.xml: line 3", "</b>"});
  expectError<InputError>([] { parseXml("<a><b", "t"); }, {"`>` is missing"});
  expectError<InputError>([] { parseXml("<a>text", "t"); }, {"</a> is missing"});
  expectError<InputError>(
      [] {
        std::string deep;
        for (int i = 0; i < 100000; ++i) deep += "<a>";
        parseXml(deep, "t");
      },
      {"nested"});
}

TEST(Numbers, AreReadWhateverTheLocaleAndRefusedInPart) {
  EXPECT_EQ(numberOf("1.5e-3"), 1.5e-3);
  EXPECT_EQ(numberOf("+.5"), 0.5);
  EXPECT_EQ(numberOf("500."), 500.0);
  EXPECT_TRUE(std::isnan(*numberOf(".Nan")));
  EXPECT_EQ(numberOf("-.Inf"), -INFINITY);
  for (const char* word : {"", "1x", "0x10", "--1", "+-1", "1,5", "e5"})
    EXPECT_FALSE(numberOf(word)) << word;
  EXPECT_EQ(numberOf(exactText(0.1)), 0.1);
}

TEST(Numbers, AreWrittenWithAsManyDecimalsAsPrintfDoes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-9, 9);
  std::vector<double> values{0, -0.0, 0.00005, -0.00015, 2.5, NAN, INFINITY, -1.7e308};
  for (int i = 0; i < 2000; ++i)
    values.push_back((i % 2 == 0 ? 1 : -1) * std::pow(10, exponent(random)));
  for (const double value : values)
    for (const int decimals : {0, 4, 9}) {
      char expected[400];
      std::snprintf(expected, sizeof expected, "%.*f", decimals, value);
      EXPECT_EQ(fixedText(value, decimals), expected);
    }
  EXPECT_THROW(fixedText(-1.7e308, 90), Error);
}

TEST(Numbers, RowsLeaveHeadingsOut) {
  const auto rows = numberRows("Left camera:\r\n1 2\r\n\n 3;4,5 \nK 1 2\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].line, 2);
  EXPECT_EQ(rows[1].values, (std::vector<double>{3, 4, 5}));
}

}  // namespace
}  // namespace softscope::test
