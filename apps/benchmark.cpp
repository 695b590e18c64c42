// apps/benchmark.cpp: `softscope benchmark`: a data set's clips to its official table.
#include <filesystem>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "io/files/folder.h"
#include "toolkit/benchmark/stir_benchmark.h"
#include "toolkit/record/child_process.h"

namespace softscope {
namespace {

class BenchmarkCommand : public Command {
 public:
  std::string name() const override { return "benchmark"; }
  std::string summary() const override {
    return "clips of a data set to its official scores and submission file";
  }
  std::string details() const override {
    return "NAME: stir2026. DATA: one clip as it is shipped, or a folder of clips.\n"
           "Each clip is reconstructed by a process of its own; a clip that is done is not run "
           "again,\n"
           "one that fails is excluded and named. Prints the official table with the control\n"
           "`nothing moves`; writes DIR/benchmark.json, DIR/preds.json (for the board) and\n"
           "DIR/clips/NAME with run and log (docs/datasets.md).";
  }
  std::string example() const override {
    return "softscope benchmark stir2026 STIR2026/val --out stir_val";
  }
  void declare(ArgumentList& arguments) override {
    arguments.positional("NAME", benchmark_, "stir2026", true);
    arguments.positional("DATA", data_, "a clip, or a folder of clips", true);
    arguments.option("--out", "DIR", out_, "folder for runs and results", true);
    arguments.option("--set", "KEY=VALUE", settings_,
                     "a setting of `reconstruct`; repeatable (`softscope settings`)");
    arguments.flag("--force", force_, "reconstruct clips again that are done");
  }
  int run() override;

 private:
  std::string benchmark_, data_, out_;
  std::vector<std::string> settings_;
  bool force_ = false;
};

int BenchmarkCommand::run() {
  require(benchmark_ == "stir2026", "NAME", benchmark_, "only stir2026 can be run");
  if (isThere(out_) && !isFolder(out_))
    throw OptionError("--out " + out_ + ": is a file, but must be a folder, there or not yet");
  InterruptGuard interrupt;
  const StirBenchmarkOptions options{data_, out_, settings_, force_};
  const auto run_softscope = [&](std::vector<std::string> words, const std::filesystem::path& log) {
    words.insert(words.begin(), ownExecutable().string());
    words.insert(words.end(), {"--threads", std::to_string(common.threads)});
    return runToEnd(ChildProcess(words, log), [&] { return interrupt.requested(); });
  };
  StirBenchmarkResult result;
  {
    WorkProgress progress("benchmark", progressStyle(common.quiet), interrupt);
    result = benchmarkStir(options, run_softscope, progress.callback());
  }
  if (result.stopped) return kInterrupted;
  FactSheet facts = stirBenchmarkFacts(result);
  facts.addLine("written", out_ + "/benchmark.json, " + out_ + "/preds.json");
  printFacts(facts, common.json);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeBenchmarkCommand() { return std::make_unique<BenchmarkCommand>(); }

}  // namespace softscope
