// toolkit/face/figure.cpp: implementation of include/softscope/figure.h.
#include "softscope/figure.h"

#include "toolkit/figures/draw_figure.h"
#include "toolkit/figures/figure_outputs.h"

namespace softscope::api {

std::vector<std::string> figure(const FigureContents& contents,
                                const std::vector<std::string>& files,
                                const FigureStyleChoice& style, bool overwrite) {
  require(!files.empty(), "files", "empty", "a figure needs one or more files");
  FigureRequest request;
  request.page.out = files;
  request.page.style = style.name;
  request.page.width_mm = style.width_mm;
  request.page.dots_per_inch = style.dots_per_inch;
  request.page.force = overwrite;
  request.kind = contents.kind;
  request.run = contents.run;
  request.ct = contents.ct;
  request.reference = contents.reference;
  request.test = contents.test;
  request.surfaces = contents.surfaces;
  request.scans = contents.scans;
  request.fit = parseFit(contents.align, contents.landmarks, "landmarks");
  request.errors.kind = contents.errors;
  request.errors.range_mm = contents.range_mm;
  request.frame = contents.frame;
  const DrawnFigure drawn = drawFigure(request);
  writeFigure(drawn.drawing, request.page, drawn.record);
  return drawn.warnings;
}

}  // namespace softscope::api
