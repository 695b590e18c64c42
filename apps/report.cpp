// apps/report.cpp: `softscope report`: page of evaluations.
#include <spdlog/spdlog.h>

#include "apps/command.h"
#include "apps/result_output.h"
#include "apps/threshold_exit.h"
#include "toolkit/report/write_report.h"

namespace softscope {
namespace {

const char* const kReportDetails =
    "CASE is a folder written by `evaluate --out` or `compare --out`; several form a cohort.\n"
    "The page opens from disk in any browser without network access: compared data, alignment,\n"
    "result with its uncertainty, a rotatable map of the errors, limits, methods, provenance, and\n"
    "all metrics as JSON.\n"
    "Names of files and folders are removed unless --with-paths is given; cases are numbered, or\n"
    "named by --name. docs/report.md explains the report.";

class ReportCommand : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override {
    return "report of evaluations and comparisons as one page";
  }
  std::string details() const override { return kReportDetails; }
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
  arguments.positionals("CASE", options_.cases, "folders written by evaluate or compare");
  arguments.option("--out", "FILE", out_, "the page, .html", true);
  arguments.option("--pdf", "FILE", pdf_, "the same page as PDF");
  arguments.option("--name", "TEXT", options_.names,
                   "name of each case, in their order; repeatable");
  arguments.option("--versus", "CASE", options_.versus,
                   "result of another method for each case, in their order; repeatable");
  arguments.option("--title", "TEXT", options_.title, "of the page");
  arguments.option("--limit-mm", "N", options_.limit_mm,
                   "end of the colour range (default 0: a round number above the largest P95)");
  arguments.option("--seed", "N", options_.seed,
                   "of the bootstrap for confidence intervals (default 1)");
  arguments.option("--fail-if", "LIMIT", fail_if_,
                   "e.g. p95_mm>2: exit code 1 if true for a case; repeatable");
  arguments.option(
      "--checklist", "NAME", options_.checklist,
      "claim, stard-ai: adds the items of that guideline, with their place in the report");
  arguments.flag("--with-paths", options_.with_paths,
                 "show names of inputs, and their paths if recorded");
  arguments.flag("--force", options_.overwrite, "overwrite existing files");
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
