// toolkit/export/export_model.h: models, reports and images as files of other programs.
#pragma once

#include <string>

#include "mesh/surface_from_points.h"
#include "toolkit/export/export_dicom.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct ExportRequest {
  std::string input;         // a run, points or a mesh; for .dcm also a report or an image
  std::string out;           // file; its ending is the format, .pvd a series of .vtp
  std::string unit;          // mm, cm or m; empty: the format's own
  SurfaceOptions surface;    // from points to triangles
  DicomTexts dicom;          // of .dcm
  int frame = -1;            // of a run; -1: its last model
  int every = 1;             // of a series: each n-th saved model
  double input_unit_mm = 1;  // length of a unit of the input
  bool points = false;       // points instead of triangles
  bool overwrite = false;

  bool isSeries() const;
  /// Throws OptionError.
  void validate() const;
};

struct ExportResult {
  FactSheet facts{""};
  bool interrupted = false;  // then nothing is written
};

/// `progress` counts the models of a series. Throws OptionError, InputError; BackendError where
/// DICOM's tools are missing.
ExportResult exportModel(const ExportRequest& request, const Progress& progress = {});

}  // namespace softscope
