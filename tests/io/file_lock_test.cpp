#include "io/files/file_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <memory>

#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

TEST(FileLock, OneHolderAtATimeAndEverybodyMayAsk) {
  TemporaryFolder folder;
  const auto file = folder / "writing.lock";
  EXPECT_FALSE(isHeld(file)) << "asking makes no file";
  EXPECT_FALSE(std::filesystem::exists(file));
  auto first = std::make_unique<FileLock>(file);
  EXPECT_FALSE(isHeld(file)) << "made, not yet held";
  EXPECT_TRUE(first->tryToHold());
  EXPECT_TRUE(isHeld(file));
  EXPECT_FALSE(FileLock(file).tryToHold());
  first.reset();
  EXPECT_FALSE(isHeld(file));
  EXPECT_TRUE(FileLock(file).tryToHold());
}

TEST(FileLock, EndsWithAProcessThatIsKilled) {
  TemporaryFolder folder;
  const auto file = folder / "writing.lock";
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FileLock lock(file);
    const char letter = lock.tryToHold() ? 'y' : 'n';
    if (write(ready[1], &letter, 1) != 1) _exit(1);
    pause();
    _exit(0);
  }
  char letter = 0;
  ASSERT_EQ(read(ready[0], &letter, 1), 1);
  EXPECT_EQ(letter, 'y');
  EXPECT_TRUE(isHeld(file));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(isHeld(file));
  close(ready[0]);
  close(ready[1]);
}

}  // namespace
}  // namespace softscope::test
