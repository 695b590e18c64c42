// toolkit/export/export_model.h: models, reports and images as files of other programs.
#pragma once

#include <string>

#include "core/length_unit.h"
#include "mesh/surface_from_points.h"
#include "toolkit/export/export_dicom.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct ExportRequest {
  std::string input;       // run, points or mesh; for .dcm also a report or an image
  std::string out;         // file; its extension is the format, .pvd is a series of .vtp
  std::string unit;        // mm, cm or m; empty: default of the format
  SurfaceOptions surface;  // triangulation of points
  DicomTexts dicom;        // of .dcm
  int frame = -1;          // frame of a run; -1: last model
  int every = 1;           // for a series: every n-th saved model
  double input_unit_mm = kUnitOfFile;
  bool points = false;  // points instead of triangles
  bool overwrite = false;

  bool isSeries() const;
  /// Throws OptionError.
  void validate() const;
};

struct ExportResult {
  FactSheet facts{""};
  bool interrupted = false;  // then no file is written
};

/// `progress` counts the models of a series. Throws OptionError,
/// InputError; BackendError without the tools of DICOM.
ExportResult exportModel(const ExportRequest& request, const Progress& progress = {});

}  // namespace softscope
