// toolkit/report/report_case.h: what `evaluate` and `compare` left, ready to be reported.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "eval/statistics/statistics.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/files/error_map.h"

namespace softscope {

/// A number by its path with dots; NaN where it isn't there, or is none.
double numberAt(const FactSheet::Json& record, const std::string& path);
/// A text by its path; empty where it isn't there, or is none.
std::string textAt(const FactSheet::Json& record, const std::string& path);

struct ReportCase {
  /// evaluate against truth, a mesh, images alone (no truth); compare
  enum class Kind { kSequence, kMesh, kPictures, kPair };

  std::string name;  // as the report calls it
  Kind kind = Kind::kPair;
  FactSheet::Json record;      // evaluation.json or comparison.json, as it was written
  std::vector<ErrorMap> maps;  // of a series one a moment; may be empty
  std::vector<std::pair<std::string, std::string>> pictures;  // caption, PNG
  std::string drawn_view;  // PNG: the image beside the model drawn from its place; may be empty
  std::vector<std::pair<std::string, std::string>> hashes;  // what, SHA-256

  bool hasTruth() const { return kind != Kind::kPictures; }
  /// Where distances of the model stand in the record, or else what there is.
  std::string mainPart() const {
    return kind == Kind::kPair ? "accuracy" : hasTruth() ? "surface" : "view";
  }
  double main(const std::string& key) const { return numberAt(record, mainPart() + "." + key); }
  /// How the model was aligned to the reference; empty or "none" where it was not.
  std::string alignment() const {
    return textAt(record, kind == Kind::kPair ? "alignment.method" : "comparison.alignment");
  }
  /// One value a judged moment; empty for a pair.
  std::vector<double> overFrames(const std::string& key) const;
};

/// The frames of a record, over time where the clip has a clock, else over their numbers.
struct CaseFrames {
  std::string x_label;
  std::vector<double> x;              // rising
  std::vector<FactSheet::Json> rows;  // one per x
  std::vector<std::string> outcomes;  // fused, skipped, lost; empty where the record says nothing

  /// Of the frames that were fused and have the value; NaN for those that were not fused, and for
  /// the first and the last one, so that all series span the same frames; the others are left out.
  std::vector<std::pair<double, double>> series(const std::string& key) const;
  std::size_t fused() const;
};

/// Without rows where the record has no frames, or they are not in order.
CaseFrames framesOf(const ReportCase& c);

/// `path`: the folder, or the JSON file in it. Throws InputError: neither, broken, of another
/// version; for a run that wasn't evaluated it says what to do.
ReportCase readReportCase(const std::filesystem::path& path);

/// Thins points, coarsens surfaces and leaves moments out until all maps together are small enough
/// for a page (300 000 vertices).
void fitIntoPage(std::vector<ReportCase>& cases);

}  // namespace softscope
