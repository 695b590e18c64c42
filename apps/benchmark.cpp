// apps/benchmark.cpp: `softscope benchmark`: official table of a data set.
#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "io/files/folder.h"
#include "toolkit/benchmark/c3vd_benchmark.h"
#include "toolkit/benchmark/depth_benchmark.h"
#include "toolkit/benchmark/end_point_benchmark.h"
#include "toolkit/benchmark/path_benchmark.h"
#include "toolkit/benchmark/stir_benchmark.h"
#include "toolkit/benchmark/surgt_benchmark.h"
#include "toolkit/record/child_process.h"
#include "toolkit/record/machine.h"

namespace softscope {
namespace {

constexpr const char* kNames = "stir2026, stir, surgt, scared, servct, stereomis or c3vd";
const char* const kBenchmarkDetails =
    "NAME: stir2026, stir, surgt, scared, servct, stereomis or c3vd. DATA: a clip in its original\n"
    "layout, or a folder of clips. Each clip is run in its own process; a complete clip is not\n"
    "repeated, a failed clip is excluded and named. Prints the official table with its control "
    "(no\n"
    "motion, no depth), protocol, exclusions, coverage, 95 % intervals and latency; writes\n"
    "DIR/benchmark.json, DIR/preds.json (for STIR's board) and DIR/clips/NAME with run and log\n"
    "(docs/datasets.md).";

class BenchmarkCommand : public Command {
 public:
  std::string name() const override { return "benchmark"; }
  std::string summary() const override {
    return "official scores and submission file of a data set";
  }
  std::string details() const override { return kBenchmarkDetails; }
  std::string example() const override {
    return "softscope benchmark stir2026 STIR2026/val --out stir_val";
  }
  void declare(ArgumentList& arguments) override {
    arguments.positional("NAME", benchmark_, kNames, true);
    arguments.positional("DATA", data_, "a clip, or a folder of clips", true);
    arguments.option("--out", "DIR", out_, "folder for runs and results", true);
    arguments.option("--set", "KEY=VALUE", settings_,
                     "setting of the command that is run; repeatable (`softscope settings`)");
    arguments.option("--jobs", "N", jobs_,
                     "parallel clips, which share --threads (1, the default, for valid latencies)");
    arguments.flag("--force", force_, "repeat complete clips");
  }
  int run() override;

 private:
  std::optional<FactSheet> table(const BenchmarkOptions& options, const InterruptGuard& interrupt);

  std::string benchmark_, data_, out_;
  std::vector<std::string> settings_;
  int jobs_ = 1;
  bool force_ = false;
};

/// None after an interruption.
std::optional<FactSheet> BenchmarkCommand::table(const BenchmarkOptions& options,
                                                 const InterruptGuard& interrupt) {
  const int cores = common.threads > 0 ? common.threads : describeMachine().cores;
  const int threads = std::max(1, cores / jobs_);
  const RunSoftscope run_softscope = [&](std::vector<std::string> words,
                                         const std::filesystem::path& log) {
    words.insert(words.begin(), executablePath().string());
    words.insert(words.end(), {"--threads", std::to_string(threads)});
    return runToEnd(ChildProcess(words, log), [&] { return interrupt.requested(); });
  };
  WorkProgress progress("benchmark", progressStyle(common.quiet), interrupt);
  const auto facts = [](const auto& result, FactSheet (*const of)(decltype(result))) {
    return result.stopped ? std::nullopt : std::optional<FactSheet>(of(result));
  };
  if (benchmark_ == "surgt")
    return facts(benchmarkSurgt(options, run_softscope, progress.callback()), surgtBenchmarkFacts);
  if (benchmark_ == "servct")
    return facts(benchmarkServCt(options, run_softscope, progress.callback()), depthBenchmarkFacts);
  if (benchmark_ == "stir")
    return facts(benchmarkStirEnds(options, run_softscope, progress.callback()), endPointFacts);
  if (benchmark_ == "stereomis")
    return facts(benchmarkStereoMis(options, run_softscope, progress.callback()),
                 pathBenchmarkFacts);
  if (benchmark_ == "c3vd") {
    const C3vdBenchmarkResult result = benchmarkC3vd(options, run_softscope, progress.callback());
    if (result.path.stopped) return std::nullopt;
    return c3vdBenchmarkFacts(result);
  }
  if (benchmark_ == "scared")
    return facts(benchmarkScared(options, run_softscope, progress.callback()), depthBenchmarkFacts);
  return facts(benchmarkStir(options, run_softscope, progress.callback()), stirBenchmarkFacts);
}

int BenchmarkCommand::run() {
  const std::vector<std::string> known{"stir2026", "stir",      "surgt", "scared",
                                       "servct",   "stereomis", "c3vd"};
  require(std::find(known.begin(), known.end(), benchmark_) != known.end(), "NAME", benchmark_,
          std::string("must be ") + kNames);
  require(jobs_ >= 1, "--jobs", jobs_, "must be 1 or more");
  if (isThere(out_) && !isFolder(out_))
    throw OptionError("--out " + out_ + ": is a file, but must be a new or existing folder");
  const InterruptGuard interrupt;
  std::optional<FactSheet> facts = table({data_, out_, settings_, force_, jobs_}, interrupt);
  if (!facts) return kInterrupted;
  facts->addLine("written", out_ + "/benchmark.json" +
                                (benchmark_ == "stir2026" ? ", " + out_ + "/preds.json" : ""));
  printFacts(*facts, common.json);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeBenchmarkCommand() { return std::make_unique<BenchmarkCommand>(); }

}  // namespace softscope
