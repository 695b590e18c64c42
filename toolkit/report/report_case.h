// toolkit/report/report_case.h: results of `evaluate` and `compare` as input of a report.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "eval/statistics/statistics.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_values.h"
#include "vtk_views/files/error_map.h"

namespace softscope {

struct ReportCase {
  /// evaluate against truth, a mesh, images only (no truth); compare
  enum class Kind { kSequence, kMesh, kPictures, kPair };

  std::string name;  // in the report
  Kind kind = Kind::kPair;
  FactSheet::Json record;      // evaluation.json or comparison.json, unchanged
  std::vector<ErrorMap> maps;  // of a series one per frame; may be empty
  std::vector<std::pair<std::string, std::string>> pictures;  // caption, PNG
  std::string drawn_view;  // PNG: image and rendered model side by side; may be empty
  std::vector<std::pair<std::string, std::string>> hashes;  // description, SHA-256

  bool hasTruth() const { return kind != Kind::kPictures; }
  /// Part of the record with distances of the model, or the main part without truth.
  std::string mainPart() const {
    return kind == Kind::kPair ? "accuracy" : hasTruth() ? "surface" : "view";
  }
  double main(const std::string& key) const { return numberAt(record, mainPart() + "." + key); }
  /// Method of alignment to the reference; empty or "none" without alignment.
  std::string alignment() const {
    return textAt(record, kind == Kind::kPair ? "alignment.method" : "comparison.alignment");
  }
  /// One value per evaluated frame; empty for a pair.
  std::vector<double> overFrames(const std::string& key) const;
};

/// Frames of a record over time, or over frame numbers without timestamps.
struct CaseFrames {
  std::string x_label;
  std::vector<double> x;              // ascending
  std::vector<FactSheet::Json> rows;  // one per x
  std::vector<std::string> outcomes;  // fused, skipped, lost; empty if unknown

  /// Values of the fused frames that have one; NaN for frames that were not fused and for the
  /// first and last frame, so that all series cover the same frames. Other frames are omitted.
  std::vector<std::pair<double, double>> series(const std::string& key) const;
  std::size_t fused() const;
};

/// Empty if the record has no frames, or they are not in order.
CaseFrames framesOf(const ReportCase& c);

/// `path`: the folder, or its JSON file. Throws InputError: neither, damaged,
/// another version; for a run without evaluation with the command to use.
ReportCase readReportCase(const std::filesystem::path& path);

/// Selects points, decimates surfaces and drops frames until
/// all maps together fit into a page (300 000 vertices).
void fitIntoPage(std::vector<ReportCase>& cases);

}  // namespace softscope
