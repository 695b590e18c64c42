#include "io/files/new_files.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/error.h"
#include "temporary_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

TEST(NewFiles, AreTakenBackUnlessKept) {
  const TemporaryFolder folder;
  put(folder / "earlier.txt", "before");
  {
    NewFiles files;
    files.makeFolder(folder / "a/b");
    files.make(folder / "a/b/new.txt", [&] { put(folder / "a/b/new.txt", "one"); });
    files.make(folder / "earlier.txt", [&] { put(folder / "earlier.txt", "after"); });
  }
  EXPECT_FALSE(fs::exists(folder / "a")) << "with the folders that were made";
  EXPECT_EQ(get(folder / "earlier.txt"), "after") << "what replaced a file stays";
  NewFiles files;
  files.make(folder / "new.txt", [&] { put(folder / "new.txt", "two"); });
  files.keep();
  EXPECT_EQ(get(folder / "new.txt"), "two");
}

TEST(NewFiles, AFolderBelowAFileIsAnErrorThatNamesIt) {
  const TemporaryFolder folder;
  put(folder / "file", "text");
  NewFiles files;
  try {
    files.makeFolder(folder / "file/below");
    ADD_FAILURE() << "was made";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("file/below: Not a directory"), std::string::npos)
        << error.what();
  }
}

TEST(NewFiles, LeaveWhatOthersWrote) {
  const TemporaryFolder folder;
  {
    NewFiles files;
    files.makeFolder(folder / "a");
    put(folder / "a/theirs.txt", "theirs");
    const auto refused = [&] {
      files.make(folder / "b.txt", [&]() {
        put(folder / "b.txt", "theirs");  // appears meanwhile, so that the write fails
        throw std::runtime_error("exists");
      });
    };
    EXPECT_THROW(refused(), std::runtime_error);
  }
  EXPECT_EQ(get(folder / "a/theirs.txt"), "theirs");
  EXPECT_EQ(get(folder / "b.txt"), "theirs");
}

}  // namespace
}  // namespace softscope::test
