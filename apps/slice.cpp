// apps/slice.cpp: `softscope slice`: planes through a CT with contours of surfaces and models.
#include <spdlog/spdlog.h>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "toolkit/figures/figure_outputs.h"
#include "toolkit/figures/slice_figure.h"

namespace softscope {
namespace {

const char* const kSliceDetails =
    "Each --plane gives a panel: axial, coronal, sagittal, or oblique by its --normal. With\n"
    "--positions one plane gives a panel at each position along its axis (LPS, mm; oblique: along\n"
    "its normal from --at), so a stack of slices is one figure. Surfaces are contours, points\n"
    "within --dots-within-mm of a plane are dots, those of --scan red.\n"
    "A JSON file next to the figure has inputs, hashes and views.";

class SliceCommand : public Command {
 public:
  std::string name() const override { return "slice"; }
  std::string summary() const override {
    return "axial, coronal, sagittal and oblique slices of a CT with contours of models";
  }
  std::string details() const override { return kSliceDetails; }
  std::string example() const override {
    return "softscope slice ct.nii.gz --surface liver.ply --plane axial --out liver.png";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  SliceRequest request_;
};

void SliceCommand::declare(ArgumentList& arguments) {
  arguments.positional("VOLUME", request_.ct,
                       "DICOM folder, NIfTI, NRRD or MetaImage; without it: white", false);
  arguments.option("--reference", "MESH", request_.reference, "surface of the CT to outline");
  arguments.option("--surface", "MESH", request_.surfaces,
                   "model to outline; repeatable; --at model is the centre of the first");
  arguments.option("--scan", "POINTS", request_.scans, "points to draw in red; repeatable");
  arguments.option("--plane", "NAME", request_.planes,
                   "axial, coronal, sagittal or oblique; repeatable (default: the first three)");
  arguments.option("--normal", "X,Y,Z", request_.normal, "of the oblique plane");
  arguments.option("--positions", "LIST", request_.positions,
                   "positions of one plane along its axis, mm: 10,20,30, or FIRST:LAST:STEP");
  arguments.option("--columns", "N", request_.columns, "panels per row");
  softscope::declare(request_.page, arguments);
}

int SliceCommand::run() {
  const DrawnFigure figure = drawSliceFigure(request_);
  for (const std::string& warning : figure.warnings) spdlog::warn("{}", warning);
  writeFigure(figure.drawing, request_.page, figure.record);
  reportWritten(request_.page.out, request_.page.recordFile());
  if (common.json) printJson(figure.record);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeSliceCommand() { return std::make_unique<SliceCommand>(); }

}  // namespace softscope
