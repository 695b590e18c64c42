// toolkit/figures/slice_figure.h: planes through a CT with contours of surfaces and models.
#pragma once

#include <string>
#include <vector>

#include "toolkit/figures/draw_figure.h"
#include "toolkit/figures/figure_options.h"

namespace softscope {

struct SliceRequest {
  FigureOptions page;                 // files, style, window, centre
  std::string ct;                     // DICOM folder, NIfTI, NRRD or MetaImage; empty: white
  std::string reference;              // surface segmented from the CT
  std::vector<std::string> surfaces;  // models to outline
  std::vector<std::string> scans;     // points, drawn in red
  std::vector<std::string> planes;    // axial, coronal, sagittal, oblique; empty: the first three
  std::string normal;                 // X,Y,Z of the oblique plane
  std::string positions;              // mm along the axis of one plane: 10,20,30 or FIRST:LAST:STEP
  int columns = 0;                    // panels per row; 0: from the style

  /// Throws OptionError.
  void validate() const;
};

/// One panel per plane or position. Writes no file: see
/// writeFigure(). Throws OptionError, InputError, BackendError.
DrawnFigure drawSliceFigure(const SliceRequest& request);

}  // namespace softscope
