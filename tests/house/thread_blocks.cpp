// tests/house/thread_blocks.cpp: the search for leaks copes with threads that hold memory at exit.
//   thread_blocks LIBRARY        ends well: nothing is lost
//   thread_blocks LIBRARY leak   loses 1234 bytes, which must be found
#include <dlfcn.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace {

using Hold = const char* (*)();

class Gathering {
 public:
  void arrive() {
    const std::lock_guard lock(mutex_);
    ++arrived_;
    changed_.notify_one();
  }
  void waitFor(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return arrived_ == count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int arrived_ = 0;
};

/// Each of 100 threads takes its blocks from pages of its own, so that some begin such a page.
void startThreads(Hold hold) {
  constexpr int kThreads = 100;
  static Gathering gathering;  // outlives main(), as the threads do
  for (int i = 0; i < kThreads; ++i)
    std::thread([hold] {
      hold();
      gathering.arrive();
      for (;;) pause();
    }).detach();
  gathering.waitFor(kThreads);
}

[[gnu::noinline]] void lose() {
  void* volatile lost = std::malloc(1234);
  static_cast<void>(lost);  // gone with this function's frame
}

}  // namespace

int main(int count, char** words) {
  void* library = count < 2 ? nullptr : dlopen(words[1], RTLD_NOW);
  if (library == nullptr) {
    std::fprintf(stderr, "usage: thread_blocks LIBRARY [leak]\n");
    return 2;
  }
  startThreads(reinterpret_cast<Hold>(dlsym(library, "holdInThreadBlock")));
  if (count > 2) lose();
  return 0;
}
