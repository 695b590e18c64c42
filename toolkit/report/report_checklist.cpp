// toolkit/report/report_checklist.cpp: items of CLAIM (Mongan, Moy,
// Kahn 2020) and STARD-AI (Sounderajah et al., Nature Medicine 2025).
#include "toolkit/report/report_checklist.h"

#include <vector>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {
namespace {

struct ChecklistItem {
  const char *number, *asks, *here, *author;  // null: none
};

const char* const kMethodsHere = "Methods";
const char* const kProvenanceHere = "Provenance";

const std::vector<ChecklistItem> kClaim{
    {"1", "title or abstract names the kind of method", "title",
     "\"computer vision\" in the title"},
    {"2", "structured summary of design, methods, results", "", "write the abstract"},
    {"3", "background and intended clinical role", "", "write; research use only"},
    {"4", "aims and hypotheses", "", "write"},
    {"5", "prospective or retrospective", "", "write"},
    {"6", "goal: new method, feasibility, comparison", "", "write"},
    {"7", "where the data come from", kProvenanceHere,
     "name site, device, dates as far as allowed"},
    {"8", "who or what was included, and why", "", "write"},
    {"9", "preprocessing", kProvenanceHere, "say what was cut, scaled or masked before"},
    {"10", "parts of the data that were selected", "Result: frames fused, skipped, lost",
     "say why these frames or clips"},
    {"11", "definition of data elements", kMethodsHere, ""},
    {"12", "removal of identifying data", "", "write how; file names stay out of this report"},
    {"13", "missing data", "Result: frames skipped and lost", "state other exclusions"},
    {"14", "definition of the reference standard", "What was compared", "say how it was made"},
    {"15", "why that reference", "", "write"},
    {"16", "who annotated the reference", "", "name qualifications"},
    {"17", "tools of annotation", "", "write"},
    {"18", "variability of annotators", "", "measure, or say why not"},
    {"19", "sample size and how it was chosen", "", "write"},
    {"20", "assignment to training and test", "", "nothing is trained here; say so"},
    {"21", "level at which these are separate", "", "patient, procedure or clip; say so"},
    {"22", "description of the method", kProvenanceHere, "cite the method and this program"},
    {"23", "libraries and versions", kProvenanceHere, ""},
    {"24", "initial values", kProvenanceHere, "the settings are those of run.json"},
    {"25", "training", "", "nothing is trained here; say how settings were chosen"},
    {"26", "choice of the final model", "", "say on which clips settings were chosen"},
    {"27", "ensembles", "", "none; say so"},
    {"28", "measures of performance", kMethodsHere, ""},
    {"29", "statistics and uncertainty", "Result and uncertainty",
     "one clip has no interval; several clips give one"},
    {"30", "robustness", "", "vary settings or clips (softscope study)"},
    {"31", "explanation", "Pictures: error map", ""},
    {"32", "test on external data", "", "say whether clips come from another site"},
    {"33", "flow of cases", "Result: frames fused, skipped, lost", "draw the flow of the cases"},
    {"34", "characteristics of the cases", "", "write"},
    {"35", "performance on every part of the data", "Result", "every clip, not the best one"},
    {"36", "accuracy with its precision", "Result and uncertainty", ""},
    {"37", "analysis of failures", "Result: strip over time; Limits", "look at lost frames"},
    {"38", "limitations", "Limits", "add those of the study"},
    {"39", "meaning for practice", "", "write; research use only"},
    {"40", "registration number", "", "write"},
    {"41", "where the protocol lies", "", "write"},
    {"42", "funding", "", "write"}};

/// The index test is the reconstructed model; the reference standard is its reference.
const std::vector<ChecklistItem> kStardAi{
    {"1", "title or abstract names an accuracy study of such a method, and a measure", "title",
     "name the measure (mean distance, P95)"},
    {"2", "structured summary of design, methods, results", "", "write the abstract"},
    {"3", "background, intended use, new or established, place in the workflow", "",
     "write; research use only"},
    {"4", "aims and hypotheses", "", "write"},
    {"5", "prospective or retrospective", "", "write"},
    {"6", "ethics approval, or why none is needed", "", "write"},
    {"7", "inclusion and exclusion, of participants and of data, in their order",
     "Result: frames fused, skipped, lost", "say which clips and frames were left out before"},
    {"8", "how eligible participants were found", "", "write"},
    {"9", "where and when", "", "write"},
    {"10", "consecutive, random or convenience series", "", "write"},
    {"11", "source of the data: routine, made for the study, public", kProvenanceHere,
     "name the source; its hashes stand here"},
    {"12", "who annotated, with which experience, and when", "",
     "of masks, landmarks, registrations"},
    {"13", "devices of the recording; software of the index test with version", kProvenanceHere,
     "name maker and model of the endoscope"},
    {"14", "acquisition and preprocessing, so that it can be repeated", kProvenanceHere,
     "say how the clip was recorded, cut, scaled, masked"},
    {"15a", "index test, so that it can be repeated", kProvenanceHere,
     "cite the method and this program; settings are those of run.json"},
    {"15b", "how the index test was developed, with sample sizes", "",
     "nothing is trained here; say on which clips settings were chosen"},
    {"15c", "cut-offs of the index test, fixed before or found later", "Result: limits (--fail-if)",
     "say whether limits were set before"},
    {"15d", "who is meant to use it, with which expertise", "", "write"},
    {"16a", "reference standard, so that it can be repeated", "What was compared",
     "say how it was made"},
    {"16b", "why that reference", "", "write"},
    {"16c", "cut-offs of the reference standard", "", "write, or none"},
    {"17a", "whether the reference was known to the users of the index test", "",
     "the program does not see it; say whether settings were chosen by it"},
    {"17b", "whether the result was known to the authors of the reference", "", "write"},
    {"18", "how accuracy is estimated and compared", kMethodsHere, ""},
    {"19", "how indeterminate results are handled", "Methods; Result: frames fused, skipped, lost",
     "lost frames are not included in means; say so"},
    {"20", "how missing data are handled", "Result; Limits", "state other exclusions"},
    {"21", "analyses of variability, planned or exploratory", "", "vary clips or settings (study)"},
    {"22", "sample size and how it was chosen", "", "write"},
    {"23", "analysis of errors, bias and fairness", "Pictures: error map; Result: strip over time",
     "say for which organs, devices and patients it was done"},
    {"24", "flow of participants, drawn", "Result: frames fused, skipped, lost",
     "draw the flow of the cases"},
    {"25", "characteristics of the cases, of each part of the data", "", "write"},
    {"26a", "severity of disease in those with the condition", "", "write, or does not apply"},
    {"26b", "other diagnoses in those without it", "", "write, or does not apply"},
    {"27", "time and treatment between index test and reference", "What was compared",
     "tissue deforms: say what lay between clip and CT"},
    {"28", "whether the data represent the intended use", "", "write"},
    {"29", "how external data differ", "", "say whether clips come from another site"},
    {"30", "results against those of the reference", "Result: tables; Pictures: spread", ""},
    {"31", "accuracy with its precision", "Result, and how sure it is",
     "one clip has no interval; several clips give one"},
    {"32", "adverse events", "", "write"},
    {"33", "limitations: bias, uncertainty, generalisability", "Limits", "add those of the study"},
    {"34", "meaning for practice", "", "write; research use only"},
    {"35", "ethics and fairness of its use", "", "write"},
    {"36", "registration", "", "write"},
    {"37", "where the protocol lies", "", "write"},
    {"38", "funding and the funders' part", "", "write"},
    {"39", "commercial interests", "", "write"},
    {"40a", "availability of data and code", kProvenanceHere,
     "say where; ro-crate-metadata.json describes the run folder"},
    {"40b", "whether results are kept and can be audited",
     "metrics as JSON with their hash, in this page", "say where they are kept"}};

struct Checklist {
  const char *name, *title;
  const std::vector<ChecklistItem>* items;
};

const Checklist kChecklists[] = {{"claim", "CLAIM (2020)", &kClaim},
                                 {"stard-ai", "STARD-AI (2025)", &kStardAi}};

const Checklist& checklistNamed(const std::string& name) {
  for (const Checklist& list : kChecklists)
    if (name == list.name) return list;
  throw OptionError("`checklist=` is `" + printable(name) + "`, must be claim or stard-ai");
}

}  // namespace

void requireChecklist(const std::string& name) {
  if (!name.empty()) checklistNamed(name);
}

ReportTable checklistTable(const std::string& name) {
  const Checklist& list = checklistNamed(name);
  const auto orDash = [](const char* text) { return *text == '\0' ? "\u2013" : text; };
  ReportTable table{
      std::string(list.title) + ", in our words: the text of the guideline is authoritative",
      {"item", "asks for", "in this report", "left to the author"},
      {},
      /*words=*/true};
  for (const ChecklistItem& item : *list.items)
    table.rows.push_back({item.number, item.asks, orDash(item.here), orDash(item.author)});
  return table;
}

}  // namespace softscope
