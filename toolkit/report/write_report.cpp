// toolkit/report/write_report.cpp: report of cases as files.
#include "toolkit/report/write_report.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/new_files.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/report/report_checklist.h"
#include "vtk_views/report/report_html.h"
#include "vtk_views/report/report_pdf.h"

namespace softscope {
namespace {

std::vector<ReportCase> readVersus(const ReportOptions& options) {
  if (options.versus.empty()) return {};
  if (options.versus.size() != options.cases.size() || options.cases.size() < 2)
    throw OptionError(say("`versus=` is given ", options.versus.size(), " times, but there are ",
                          options.cases.size(),
                          " cases; it takes two cases or more, and one `versus=` for each"));
  std::vector<ReportCase> cases;
  for (const std::string& folder : options.versus) cases.push_back(readReportCase(folder));
  return cases;
}

std::vector<ReportCase> readCases(const ReportOptions& options) {
  if (!options.names.empty() && options.names.size() != options.cases.size())
    throw OptionError(say("`names=` is given ", options.names.size(), " times, but there are ",
                          options.cases.size(), " cases; name all or none"));
  std::vector<ReportCase> cases;
  for (std::size_t i = 0; i < options.cases.size(); ++i) {
    cases.push_back(readReportCase(options.cases[i]));
    cases.back().name = !options.names.empty() ? options.names[i] : say("Case ", i + 1);
  }
  return cases;
}

/// Throws for a file extension that contradicts the content.
void requireEnding(const std::filesystem::path& file, const char* option,
                   const std::vector<std::string>& endings, const char* content) {
  const std::string found = lowerCase(file.extension().string());
  if (std::find(endings.begin(), endings.end(), found) == endings.end())
    throw OptionError(
        say(option, " is `", shown(file), "`, but must end in ", endings[0], ": it is ", content));
}

}  // namespace

void ReportOptions::validate() const {
  require(limit_mm >= 0 && std::isfinite(limit_mm), "`limit_mm=`", limit_mm,
          "must be above 0, or 0 for automatic");
  require(seed >= 0, "`seed=`", seed, "must be 0 or more");
  requireChecklist(checklist);
  requireEnding(html, "`out=`", {".html", ".htm"}, "page; `pdf=` writes the same as PDF");
  if (!pdf.empty()) requireEnding(pdf, "`pdf=`", {".pdf"}, "report as PDF");
  requireWritable(html, overwrite);
  if (!pdf.empty()) requireWritable(pdf, overwrite);
  if (html == pdf) throw OptionError("`out=` and `pdf=` name the same file; give two");
}

ReportDocument writeReport(const ReportOptions& options) {
  options.validate();
  ReportRequest request;
  request.cases = readCases(options);
  request.versus = readVersus(options);
  request.title = options.title;
  request.limit_mm = options.limit_mm;
  request.choices = {options.with_paths, static_cast<std::uint64_t>(options.seed),
                     options.checklist};
  for (const ReportCase& c : request.cases)
    request.outcomes.push_back(checkThresholds(options.thresholds, c.record, c.mainPart()));
  ReportDocument document = makeReport(std::move(request));
  const std::string html = reportHtml(document.page);
  const std::string pdf = options.pdf.empty() ? "" : reportPdf(document.page);
  NewFiles files;
  files.make(options.html, [&] { writeFile(options.html, html, options.overwrite); });
  if (!options.pdf.empty())
    files.make(options.pdf, [&] { writeFile(options.pdf, pdf, options.overwrite); });
  files.keep();
  return document;
}

}  // namespace softscope
