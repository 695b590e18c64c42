// apps/report.cpp: `softscope report`: evaluations as one page for people.
#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>

#include "apps/command.h"
#include "apps/result_output.h"
#include "apps/threshold_exit.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/message.h"
#include "io/new_files.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/report/report_document.h"
#include "vtk_views/report_html.h"
#include "vtk_views/report_pdf.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

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
  std::vector<ReportCase> readCases() const;
  std::vector<ReportCase> readVersus() const;

  std::vector<std::string> folders_, versus_, names_, fail_if_;
  std::string out_, pdf_, title_;
  double limit_mm_ = 0;
  int seed_ = 1;
  bool with_paths_ = false, force_ = false;
};

void ReportCommand::declare(ArgumentList& arguments) {
  arguments.positionals("CASE", folders_, "folders that evaluate or compare wrote");
  arguments.option("--out", "FILE", out_, "the page, .html", true);
  arguments.option("--pdf", "FILE", pdf_, "the same on paper");
  arguments.option("--name", "TEXT", names_, "of each case, in their order; repeatable");
  arguments.option("--versus", "CASE", versus_,
                   "another method's result of each case, in their order; repeatable");
  arguments.option("--title", "TEXT", title_, "of the page");
  arguments.option("--limit-mm", "N", limit_mm_,
                   "where the colours end (default: a round number above the largest P95)");
  arguments.option("--seed", "N", seed_, "of resampling for confidence intervals (default 1)");
  arguments.option("--fail-if", "LIMIT", fail_if_,
                   "e.g. p95_mm>2: exit code 1 where it holds for a case; repeatable");
  arguments.flag("--with-paths", with_paths_,
                 "show the names of inputs, and their paths where the record kept them");
  arguments.flag("--force", force_, "overwrite what is there");
}

std::vector<ReportCase> ReportCommand::readVersus() const {
  if (versus_.empty()) return {};
  if (versus_.size() != folders_.size() || folders_.size() < 2)
    throw OptionError(say("--versus is given ", versus_.size(), " times, but there are ",
                          folders_.size(),
                          " cases; it takes two cases or more, and one --versus for each"));
  std::vector<ReportCase> cases;
  for (const std::string& folder : versus_) cases.push_back(readReportCase(folder));
  return cases;
}

std::vector<ReportCase> ReportCommand::readCases() const {
  if (!names_.empty() && names_.size() != folders_.size())
    throw OptionError(say("--name is given ", names_.size(), " times, but there are ",
                          folders_.size(), " cases; name all or none"));
  std::vector<ReportCase> cases;
  for (std::size_t i = 0; i < folders_.size(); ++i) {
    cases.push_back(readReportCase(folders_[i]));
    cases.back().name = !names_.empty() ? names_[i] : say("Case ", i + 1);
  }
  return cases;
}

int ReportCommand::run() {
  require(limit_mm_ >= 0 && std::isfinite(limit_mm_), "--limit-mm", limit_mm_, "must be above 0");
  require(seed_ >= 0, "--seed", seed_, "must be 0 or more");
  std::vector<Threshold> thresholds;
  for (const std::string& text : fail_if_) thresholds.push_back(parseThreshold(text));
  requireWritable(out_, force_);
  if (!pdf_.empty()) requireWritable(pdf_, force_);
  if (out_ == pdf_) throw OptionError("--out and --pdf name the same file; give two");

  ReportRequest request;
  request.cases = readCases();
  request.versus = readVersus();
  request.title = title_;
  request.limit_mm = limit_mm_;
  request.choices = {with_paths_, static_cast<std::uint64_t>(seed_)};
  for (const ReportCase& c : request.cases)
    request.outcomes.push_back(checkThresholds(thresholds, c.record, c.mainPart()));
  const ReportDocument document = makeReport(std::move(request));
  for (const std::string& warning : document.warnings) spdlog::warn("{}", warning);
  const std::string html = reportHtml(document.page);
  const std::string pdf = pdf_.empty() ? "" : reportPdf(document.page);
  NewFiles files;
  files.make(out_, [&] { writeFile(out_, html, force_); });
  if (!pdf_.empty()) files.make(pdf_, [&] { writeFile(pdf_, pdf, force_); });
  files.keep();
  printResult(document.metrics, document.facts, {out_, pdf_}, common.json);
  return exitCodeOf(document.outcomes);
}

}  // namespace

std::unique_ptr<Command> makeReportCommand() { return std::make_unique<ReportCommand>(); }

}  // namespace softscope
