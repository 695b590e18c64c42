// tests/toolkit/path_words_test.cpp: no part of a hostile name is left in a sentence.
#include "toolkit/record/path_words.h"

#include <gtest/gtest.h>

#include "toolkit/record/shell_word.h"
#include "toolkit/report/report_privacy.h"

namespace softscope::test {
namespace {

std::string hidden(const std::string& text) {
  return withoutPaths(text, FactSheet::Json::object());
}

TEST(PathWords, NamesWithBlanksLeaveNothingBehind) {
  EXPECT_EQ(hidden("/data/Jane Doe/scan 3.ply: has no faces"), "[file]: has no faces");
  EXPECT_EQ(hidden("Jane Doe.ply: is empty"), "[file]: is empty");
  EXPECT_EQ(hidden("jane doe liver.stl: is empty"), "[file]: is empty");
  EXPECT_EQ(hidden("Doe, Jane/2019 visit/left.png: is cut off"), "[file]: is cut off");
  EXPECT_EQ(hidden("/mnt/Jane Doe has no calibration"), "[file] has no calibration");
  EXPECT_EQ(hidden("/mnt/jane/my clips of doe: holds no left"), "[file]: holds no left");
  EXPECT_EQ(hidden("evaluate: /mnt/Jane Doe/run: is no run"), "evaluate: [file]: is no run");
  EXPECT_EQ(hidden("C:\\Users\\Jane Doe\\a b.ply: is empty"), "[file]: is empty");
  EXPECT_EQ(hidden("the mask of Jane Doe.png is all white"), "the mask of [file] is all white");
  EXPECT_EQ(hidden("read `/a b/c d.nii.gz`, which is LPS"), "read `[file]`, which is LPS");
  EXPECT_EQ(hidden("two files: /a/Jane Doe/x.ply and /b/John Roe/y.ply; one is old"),
            "two files: [file]; one is old");
  EXPECT_EQ(hidden("Jane\nDoe.ply: bad"), "[file]: bad") << "a blank as well";
}

TEST(PathWords, ShortFoldersAreNoUnits) {
  EXPECT_EQ(hidden("jo/doe was used"), "[file] was used");
  EXPECT_EQ(hidden("run/liver has no tracks"), "[file] has no tracks");
  EXPECT_EQ(hidden("it drifts by 0.1 mm/s, or 0.02 mm/frame"),
            "it drifts by 0.1 mm/s, or 0.02 mm/frame");
}

TEST(PathWords, SentencesWithoutFilesStayAsTheyAre) {
  for (const char* text :
       {"the run has no tracks.csv; reconstruct with --track to evaluate tracks",
        "12 of 40 frames were fused: 3 were blurred", "", " two  blanks ", "a / b", "10:30 h"})
    EXPECT_EQ(hidden(text), text);
}

TEST(PathWords, FoldersGoAndNamesStay) {
  EXPECT_EQ(withoutFolders("/my study/cases/a/run: is empty", "/my study"),
            "cases/a/run: is empty");
  EXPECT_EQ(withoutFolders("reconstruct: /data/Jane Doe/left/1.png: is cut off", "out"),
            "reconstruct: 1.png: is cut off");
  EXPECT_EQ(withoutFolders("clip/left/1.png: is cut off", "out"), "clip/left/1.png: is cut off");
}

TEST(ShellWord, IsReadBackByAShell) {
  EXPECT_EQ(shellWord("data/stress.toml"), "data/stress.toml");
  EXPECT_EQ(shellWord("my study"), "'my study'");
  EXPECT_EQ(shellWord("Doe's"), "'Doe'\\''s'");
  EXPECT_EQ(shellWord(""), "''");
}

}  // namespace
}  // namespace softscope::test
