// apps/report.cpp: `softscope report`: page of evaluations.
#include <spdlog/spdlog.h>

#include "apps/command.h"
#include "apps/result_output.h"
#include "apps/threshold_exit.h"
#include "toolkit/report/write_report.h"

namespace softscope {
namespace {

const char* const kDetails =
    "CASE is a folder that `evaluate --out` or `compare --out` wrote; several make a cohort.\n"
    "The page opens from disk in any browser and asks the network for nothing: what was compared,\n"
    "how it was aligned, the result and how sure it is, a map of the errors that turns, limits,\n"
    "methods, provenance, and all metrics as JSON inside.\n"
    "Names of files and folders stay out unless --with-paths asks for them; cases are numbered, "
    "or\n"
    "named by --name. docs/report.md tells how to read it.";

class ReportCommand : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override {
    return "evaluations and comparisons as one page for people";
  }
  std::string details() const override { return kDetails; }
  std::string example() const override {
    return "softscope report evaluation --out report.html --fail-if 'p95_mm>2'";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  ReportOptions options_;
  std::string out_, pdf_;
  std::vector<std::string> fail_if_;
};

void ReportCommand::declare(ArgumentList& arguments) {
  arguments.positionals("CASE", options_.cases, "folders that evaluate or compare wrote");
  arguments.option("--out", "FILE", out_, "the page, .html", true);
  arguments.option("--pdf", "FILE", pdf_, "the same on paper");
  arguments.option("--name", "TEXT", options_.names, "of each case, in their order; repeatable");
  arguments.option("--versus", "CASE", options_.versus,
                   "another method's result of each case, in their order; repeatable");
  arguments.option("--title", "TEXT", options_.title, "of the page");
  arguments.option("--limit-mm", "N", options_.limit_mm,
                   "where the colours end (default: a round number above the largest P95)");
  arguments.option("--seed", "N", options_.seed,
                   "of resampling for confidence intervals (default 1)");
  arguments.option("--fail-if", "LIMIT", fail_if_,
                   "e.g. p95_mm>2: exit code 1 where it holds for a case; repeatable");
  arguments.option("--checklist", "NAME", options_.checklist,
                   "claim, stard-ai: adds that guideline's items, where each stands, what is left");
  arguments.flag("--with-paths", options_.with_paths,
                 "show the names of inputs, and their paths where the record kept them");
  arguments.flag("--force", options_.overwrite, "overwrite what is there");
}

int ReportCommand::run() {
  for (const std::string& text : fail_if_) options_.thresholds.push_back(parseThreshold(text));
  options_.html = out_;
  options_.pdf = pdf_;
  const ReportDocument document = writeReport(options_);
  for (const std::string& warning : document.warnings) spdlog::warn("{}", warning);
  printResult(document.metrics, document.facts, {out_, pdf_}, common.json);
  return exitCodeOf(document.outcomes);
}

}  // namespace

std::unique_ptr<Command> makeReportCommand() { return std::make_unique<ReportCommand>(); }

}  // namespace softscope
