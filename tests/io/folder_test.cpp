#include "io/files/folder.h"

#include <gtest/gtest.h>

#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

TEST(Folder, SortsAsPeopleCount) {
  EXPECT_TRUE(naturallyBefore("f2", "f10"));
  EXPECT_TRUE(naturallyBefore("f002", "f10"));
  EXPECT_FALSE(naturallyBefore("f10", "f9b"));
  EXPECT_TRUE(naturallyBefore("a1b2", "a1b11"));
  EXPECT_TRUE(naturallyBefore("f01", "f1") != naturallyBefore("f1", "f01"));
  EXPECT_FALSE(naturallyBefore("same", "same"));
  EXPECT_TRUE(naturallyBefore("99999999999999999999998", "99999999999999999999999"));
}

TEST(Folder, NamesOfFramesAreAsLongAsTheContractSays) {
  EXPECT_EQ(numberedName(38, ".ply"), "000038.ply");
  EXPECT_EQ(numberedName(0, ""), "000000");
  EXPECT_EQ(numberedName(1234567, "_left.png"), "1234567_left.png");
  EXPECT_EQ(frameNumber(numberedName(7, ".png")), 7);
}

TEST(Folder, ListsWhatIsAskedFor) {
  TemporaryFolder folder;
  for (const char* name : {"10.png", "9.PNG", ".hidden.png", "notes.txt", "11.jpg"})
    put(folder / name, "x");
  fs::create_directory(folder / "12.png");
  const auto files = filesIn(folder.path(), {".png", ".jpg"});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].filename(), "9.PNG");
  EXPECT_EQ(files[2].filename(), "11.jpg");
}

TEST(Folder, LoopsAndGapsAreErrors) {
  TemporaryFolder folder;
  fs::create_symlink("loop", folder / "loop");
  expectError<InputError>([&] { filesIn(folder / "loop", {".png"}); }, {"loop", "itself"});
  fs::create_directory(folder / "pictures");
  fs::create_symlink("1.png", folder / "pictures/1.png");
  expectError<InputError>([&] { filesIn(folder / "pictures", {".png"}); }, {"1.png", "itself"});
  fs::remove(folder / "pictures/1.png");
  fs::create_symlink("none.png", folder / "pictures/1.png");
  expectError<InputError>([&] { filesIn(folder / "pictures", {".png"}); },
                          {"1.png", "no such file"});
  expectError<InputError>([&] { filesIn(folder / "none", {".png"}); }, {"no such folder"});
  put(folder / "file", "x");
  expectError<InputError>([&] { filesIn(folder / "file", {".png"}); }, {"folder is expected"});
}

TEST(Folder, FrameNumbers) {
  EXPECT_EQ(frameNumber("left/000123.png"), 123);
  EXPECT_EQ(frameNumber("cam0_frame_07b.png"), 7);
  EXPECT_EQ(frameNumber("left.png"), std::nullopt);
  EXPECT_EQ(frameNumber("99999999999999999999.png"), std::nullopt);
}

}  // namespace
}  // namespace softscope::test
