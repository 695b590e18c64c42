// tests/toolkit/study_gpus_test.cpp: which GPU each case of a study gets.
#include "toolkit/study/study_gpus.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "support/folder_test.h"
#include "toolkit/study/run_study.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

StudyCase caseWith(const std::string& name, const std::string& backend) {
  StudyCase one;
  one.name = name;
  one.sequence = "clip-" + name;
  if (!backend.empty()) one.reconstruct["backend"] = backend;
  return one;
}

TEST(StudyGpus, AreNamedAsTheEnvironmentDoes) {
  EXPECT_THAT(gpuNames(nullptr, 3), ElementsAre("0", "1", "2"));
  EXPECT_THAT(gpuNames("2,5", 2), ElementsAre("2", "5"));
  EXPECT_THAT(gpuNames("GPU-8932,MIG-77", 2), ElementsAre("GPU-8932", "MIG-77"));
  EXPECT_THAT(gpuNames("1,-1,3", 1), ElementsAre("1")) << "CUDA stops at an invalid entry";
  EXPECT_THAT(gpuNames("", 0), IsEmpty());
  EXPECT_THAT(gpuNames(nullptr, 0), IsEmpty());
}

TEST(StudyGpus, AreAskedForWhereACaseMayUseThem) {
  Study study;
  study.cases = {caseWith("a", "cpu"), caseWith("b", "cpu")};
  EXPECT_FALSE(mayUseGpus(study));
  study.cases.push_back(caseWith("c", ""));
  EXPECT_TRUE(mayUseGpus(study)) << "auto is the default";
}

TEST(StudyGpus, ThePoolGivesTheLeastUsed) {
  GpuPool pool({"0", "1"});
  EXPECT_EQ(pool.take(), 0u);
  EXPECT_EQ(pool.take(), 1u);
  EXPECT_EQ(pool.take(), 0u);
  pool.giveBack(1);
  EXPECT_EQ(pool.take(), 1u);
}

class StudyOnGpus : public test::FolderTest {
 protected:
  /// A stand-in for softscope: writes its own GPU and the other GPUs in use.
  StudyRun studyOf(int cases, const std::vector<std::string>& gpus) const {
    write("program",
          "#!/bin/sh\nmkdir \"$0.$CUDA_VISIBLE_DEVICES\" || echo shared >> \"$0.log\"\n"
          "echo \"$CUDA_VISIBLE_DEVICES\" >> \"$0.log\"\nsleep 0.1\n"
          "rmdir \"$0.$CUDA_VISIBLE_DEVICES\"\n");
    fs::permissions(folder / "program", fs::perms::owner_all);
    StudyRun run;
    for (int k = 0; k < cases; ++k)
      run.study.cases.push_back(caseWith("case-" + std::to_string(k), ""));
    run.folder.root = folder / "out";
    run.program = folder / "program";
    run.gpus = gpus;
    return run;
  }
  std::multiset<std::string> logged() const {
    std::multiset<std::string> lines;
    std::ifstream log(folder / "program.log");
    for (std::string line; std::getline(log, line);) lines.insert(line);
    return lines;
  }
};

TEST_F(StudyOnGpus, OneProcessRunsOnAGpuByDefault) {
  runStudy(studyOf(6, {"3", "7"}));
  const auto seen = logged();
  EXPECT_EQ(seen.size(), 6u) << "none found its GPU in use";
  EXPECT_GE(seen.count("3"), 2u);
  EXPECT_GE(seen.count("7"), 2u);
  EXPECT_EQ(seen.count("3") + seen.count("7"), 6u);
}

TEST_F(StudyOnGpus, TheEnvironmentIsUntouchedWithoutGpus) {
  ASSERT_EQ(setenv("CUDA_VISIBLE_DEVICES", "as it was", 1), 0);
  StudyRun run = studyOf(1, {});
  runStudy(run);
  unsetenv("CUDA_VISIBLE_DEVICES");
  EXPECT_EQ(logged(), std::multiset<std::string>{"as it was"});
}

}  // namespace
}  // namespace softscope
