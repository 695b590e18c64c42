// toolkit/comparison/compare_files.h: a surface or model against a reference surface.
#pragma once

#include <string>
#include <vector>

#include "core/length_unit.h"
#include "core/triangle_mesh.h"
#include "toolkit/comparison/compare_record.h"
#include "toolkit/comparison/surface_fit.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/record/record_paths.h"

namespace softscope {

struct CompareOptions {
  std::string reference;  // mesh file
  std::string test;       // mesh, point cloud of `reconstruct`, or folder of a run
  int frame = -1;         // frame of a run; -1: last model
  SurfaceFitOptions fit;
  std::vector<double> taus_mm{0.5, 1, 2};  // for precision, recall, F-score and surface Dice
  std::string observed;                    // file of the observed region; empty: no split
  double observed_reach_mm = 2;            // distance within which the reference is observed
  double reference_unit_mm = kUnitOfFile, test_unit_mm = kUnitOfFile;
  std::vector<Threshold> thresholds;
  RecordPaths paths;

  /// Throws OptionError: a value out of its range, a threshold of an unknown metric.
  void validate() const;
};

struct FileComparison {
  ComparisonResult result;
  TriangleMesh reference, test;  // test: aligned to the reference
  std::vector<ThresholdOutcome> outcomes;
  FactSheet::Json record;  // content of comparison.json
};

/// Throws InputError, and OptionError as validate() does.
FileComparison compareFiles(const CompareOptions& options);

}  // namespace softscope
