#include "io/files/atomic_file.h"

#include <gtest/gtest.h>

#include "io/files/file_bytes.h"
#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

int entriesOf(const fs::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++count;
  return count;
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  TemporaryFolder folder;
  {
    AtomicFile file(folder / "a.txt", false);
    file.write("half");
    EXPECT_FALSE(fs::exists(folder / "a.txt"));
  }
  EXPECT_EQ(entriesOf(folder.path()), 0);  // nothing half-written is left behind
  AtomicFile file(folder / "a.txt", false);
  file.write("who");
  file.write("le");
  file.commit();
  EXPECT_EQ(get(folder / "a.txt"), "whole");
  EXPECT_EQ(entriesOf(folder.path()), 1);
}

TEST(AtomicFile, RefusesToOverwriteUnlessTold) {
  TemporaryFolder folder;
  writeFile(folder / "a.txt", "first", false);
  expectError<OptionError>([&] { writeFile(folder / "a.txt", "second", false); },
                           {"a.txt", "exists", "`overwrite=`"});
  EXPECT_EQ(get(folder / "a.txt"), "first");
  writeFile(folder / "a.txt", "second", true);
  EXPECT_EQ(get(folder / "a.txt"), "second");
}

TEST(AtomicFile, RefusesWhatAppearedMeanwhile) {
  TemporaryFolder folder;
  AtomicFile file(folder / "a.txt", false);
  file.write("ours");
  put(folder / "a.txt", "theirs");
  expectError<OptionError>([&] { file.commit(); }, {"a.txt", "`overwrite=`"});
  EXPECT_EQ(get(folder / "a.txt"), "theirs");
}

TEST(AtomicFile, SaysWhyItCannotWrite) {
  TemporaryFolder folder;
  expectError<Error>([&] { writeFile(folder / "no/such/a.txt", "x", false); },
                     {"a.txt", "can't be written"});
  expectError<OptionError>([&] { writeFile(folder.path(), "x", true); }, {"folder"});
  if (fs::exists("/dev/full")) {  // a disk without room; renaming onto it never happens
    fs::create_symlink("/dev/full", folder / "full");
    EXPECT_NO_THROW(writeFile(folder / "full", "x", true));  // replaces the link, not the device
    EXPECT_EQ(get(folder / "full"), "x");
  }
}

TEST(FileBytes, SaysWhatIsWrongWithAFile) {
  TemporaryFolder folder;
  put(folder / "empty", "");
  put(folder / "some", "12345678");
  fs::create_symlink("loop", folder / "loop");
  fs::create_symlink("nowhere", folder / "dangling");
  EXPECT_EQ(readBytes(folder / "some"), "12345678");
  expectError<InputError>([&] { readBytes(folder / "none"); }, {"none", "no such file"});
  expectError<InputError>([&] { readBytes(folder / "empty"); }, {"empty"});
  expectError<InputError>([&] { readBytes(folder.path()); }, {"a folder"});
  expectError<InputError>([&] { readBytes(folder / "loop"); }, {"loop", "symbolic link", "itself"});
  expectError<InputError>([&] { readBytes(folder / "dangling"); }, {"dangling", "no such file"});
  expectError<InputError>([&] { readBytes(folder / "some", 7); }, {"some", "right one"});
  expectError<InputError>([] { readBytes("/dev/zero"); }, {"device"});
  expectError<InputError>([&] { readBytes(folder / "two\nlines"); }, {"two?lines"});
}

TEST(AtomicFile, OnlyWhatDeadProcessesLeftIsAbandoned) {
  TemporaryFolder folder;
  const std::string dead = "999999999";  // above the largest number that Linux gives
  for (const std::string& name : {".a.txt." + dead + "-3.part", ".film." + dead + ".part.mp4"})
    put(folder / name, "half");
  const std::string alive = ".a.txt." + std::to_string(::getpid()) + "-7.part";
  for (const std::string& name : {alive, std::string(".mine.part"), std::string("a.5-1.part")})
    put(folder / name, "another's");
  removeAbandoned(folder.path());
  EXPECT_EQ(entriesOf(folder.path()), 3);
  EXPECT_TRUE(fs::exists(folder / alive));
  removeTemporaries(folder.path());
  EXPECT_EQ(entriesOf(folder.path()), 2) << "only names that AtomicFile gives";
}

}  // namespace
}  // namespace softscope::test
