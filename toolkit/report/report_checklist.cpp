// toolkit/report/report_checklist.cpp: CLAIM (Mongan, Moy, Kahn 2020), item by item.
#include "toolkit/report/report_checklist.h"

#include "core/error.h"

namespace softscope {
namespace {

struct ChecklistItem {
  int number;
  const char *asks, *here, *author;  // empty: nothing
};

const char* const kMethodsHere = "Methods";
const char* const kProvenanceHere = "Provenance";

const ChecklistItem kClaim[] = {
    {1, "title or abstract names the kind of method", "title", "\"computer vision\" in the title"},
    {2, "structured summary of design, methods, results", "", "write the abstract"},
    {3, "background and intended clinical role", "", "write; research use only"},
    {4, "aims and hypotheses", "", "write"},
    {5, "prospective or retrospective", "", "write"},
    {6, "goal: new method, feasibility, comparison", "", "write"},
    {7, "where the data come from", kProvenanceHere, "name site, device, dates as far as allowed"},
    {8, "who or what was included, and why", "", "write"},
    {9, "preprocessing", kProvenanceHere, "say what was cut, scaled or masked before"},
    {10, "parts of the data that were selected", "Result: frames fused, skipped, lost",
     "say why these frames or clips"},
    {11, "definition of data elements", kMethodsHere, ""},
    {12, "removal of identifying data", "", "write how; file names stay out of this report"},
    {13, "missing data", "Result: frames skipped and lost", "say what was left out besides"},
    {14, "definition of the reference standard", "What was compared", "say how it was made"},
    {15, "why that reference", "", "write"},
    {16, "who annotated the reference", "", "name qualifications"},
    {17, "tools of annotation", "", "write"},
    {18, "variability of annotators", "", "measure, or say why not"},
    {19, "sample size and how it was chosen", "", "write"},
    {20, "assignment to training and test", "", "nothing is trained here; say so"},
    {21, "level at which these are separate", "", "patient, procedure or clip; say so"},
    {22, "description of the method", kProvenanceHere, "cite the method and this program"},
    {23, "libraries and versions", kProvenanceHere, ""},
    {24, "initial values", kProvenanceHere, "the settings are those of run.json"},
    {25, "training", "", "nothing is trained here; say how settings were chosen"},
    {26, "choice of the final model", "", "say on which clips settings were chosen"},
    {27, "ensembles", "", "none; say so"},
    {28, "measures of performance", kMethodsHere, ""},
    {29, "statistics and uncertainty", "Result, and how sure it is",
     "one clip has no interval; several clips give one"},
    {30, "robustness", "", "vary settings or clips (softscope study)"},
    {31, "explanation", "Pictures: error map", ""},
    {32, "test on external data", "", "say whether clips come from another site"},
    {33, "flow of cases", "Result: frames fused, skipped, lost", "draw the flow of the cases"},
    {34, "characteristics of the cases", "", "write"},
    {35, "performance on every part of the data", "Result", "every clip, not the best one"},
    {36, "accuracy with its precision", "Result, and how sure it is", ""},
    {37, "analysis of failures", "Result: strip over time; Limits", "look at lost frames"},
    {38, "limitations", "Limits", "add those of the study"},
    {39, "meaning for practice", "", "write; research use only"},
    {40, "registration number", "", "write"},
    {41, "where the protocol lies", "", "write"},
    {42, "funding", "", "write"}};

}  // namespace

void requireChecklist(const std::string& name) {
  require(name.empty() || name == "claim", "`checklist=`", name, "must be claim");
}

ReportTable checklistTable(const std::string& name) {
  requireChecklist(name);
  ReportTable table{"CLAIM (2020), in our words: the guideline's own text counts",
                    {"item", "asks for", "in this report", "left to the author"},
                    {},
                    /*words=*/true};
  for (const ChecklistItem& item : kClaim)
    table.rows.push_back({std::to_string(item.number), item.asks,
                          *item.here == '\0' ? "\u2013" : item.here,
                          *item.author == '\0' ? "\u2013" : item.author});
  return table;
}

}  // namespace softscope
