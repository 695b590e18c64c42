// tests/toolkit/write_behind_test.cpp: order, errors and limits of work beside a loop.
#include "toolkit/run/write_behind.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "tests/io/temporary_folder.h"
#include "toolkit/run/run_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

const auto kMoment = std::chrono::milliseconds(2);

TEST(WriteBehind, WorksInOrder) {
  std::vector<int> done;
  WriteBehind writer;
  for (int i = 0; i < 20; ++i)
    writer.add([&done, i] {
      if (i % 2 == 0) std::this_thread::sleep_for(kMoment);
      done.push_back(i);
    });
  writer.finish();
  ASSERT_EQ(done.size(), 20u);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(done[i], i);
}

TEST(WriteBehind, LetsTheCallerGoOnUntilMuchIsPending) {
  std::atomic<bool> may_go{false};
  std::atomic<std::size_t> given{0};
  WriteBehind writer;
  std::thread caller([&] {
    for (std::size_t i = 0; i < WriteBehind::kMostPending + 1; ++i) {
      writer.add([&] {
        while (!may_go) std::this_thread::sleep_for(kMoment);
      });
      ++given;
    }
  });
  while (given < WriteBehind::kMostPending) std::this_thread::sleep_for(kMoment);
  std::this_thread::sleep_for(10 * kMoment);
  EXPECT_EQ(given, WriteBehind::kMostPending);
  may_go = true;
  caller.join();
  writer.finish();
}

TEST(WriteBehind, DoesNothingMoreAfterAnError) {
  WriteBehind writer;
  bool followed = false;
  writer.add([] {
    std::this_thread::sleep_for(10 * kMoment);
    throw std::runtime_error("disk full");
  });
  writer.add([] { throw std::runtime_error("second"); });
  writer.add([&] { followed = true; });
  for (int time = 0; time < 2; ++time) {
    try {
      writer.finish();
      FAIL() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "disk full");
    }
  }
  const auto addSome = [&] {
    for (std::size_t i = 0; i <= WriteBehind::kMostPending; ++i)
      writer.add([&] { followed = true; });
  };
  EXPECT_THROW(addSome(), std::runtime_error);
  EXPECT_FALSE(followed);
}

TEST(WriteBehind, KeepsNothingOfTheWorkThatIsDone) {
  WriteBehind writer;
  std::vector<std::weak_ptr<int>> held;
  for (int i = 0; i < 20; ++i) {
    auto cloud = std::make_shared<int>(i);
    held.push_back(cloud);
    writer.add([cloud = std::move(cloud)] {});
  }
  writer.finish();
  for (const std::weak_ptr<int>& cloud : held) EXPECT_TRUE(cloud.expired());
}

TEST(WriteBehind, EndsItsWorkWhenItGoes) {
  std::atomic<int> done{0};
  {
    WriteBehind writer;
    for (int i = 0; i < 3; ++i)
      writer.add([&] {
        std::this_thread::sleep_for(kMoment);
        ++done;
      });
  }
  EXPECT_EQ(done, 3);
}

TEST(WriteBehind, OneThreadWorksAtOnce) {
  const ThreadLimit one(1);
  bool done = false;
  WriteBehind writer;
  writer.add([&] { done = true; });
  EXPECT_TRUE(done);
  EXPECT_THROW(writer.add([] { throw std::runtime_error("disk full"); }), std::runtime_error);
}

TEST(WriteBehind, ARunFolderNamesAModelThatCouldNotBeWritten) {
  const TemporaryFolder folder;
  RunFolderOptions options;
  options.folder = folder / "run";
  RunFolder run(options, /*resume=*/false);
  FrameRecord frame;
  run.add(frame);
  fs::create_directories(options.folder);
  std::ofstream(options.folder / "nodes") << "a file";
  const ModelState model;
  const ScopeState scope;
  const std::vector<Submap> others;
  run.saveModel(0, 0, model);
  run.flush({"settings", 1, {model, scope, others, 1}});
  try {
    run.writeRecord(FactSheet::Json::object(), Mask(), /*complete=*/true);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr((options.folder / "nodes").string()));
  }
  EXPECT_FALSE(fs::exists(options.folder / "run.json"));
  EXPECT_FALSE(fs::exists(options.folder / "checkpoint.bin")) << "the frame is to be done again";
}

}  // namespace
}  // namespace softscope::test
