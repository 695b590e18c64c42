#include "apps/shared_arguments.h"

namespace softscope {

void declare(RecordPaths& paths, ArgumentList& arguments) {
  arguments.flag("--keep-paths", paths.keep,
                 "write whole paths into the JSON, not the names of files and folders alone");
}

void declare(VolumeArguments& volume, ArgumentList& arguments) {
  arguments.option("--spacing", "X,Y,Z", volume.spacing,
                   "of the volume's voxels along i, j, k in mm, where its file fails to say it");
  arguments.flag(
      "--allow-missing-slices", volume.allow_missing_slices,
      "read a DICOM series that lacks slices, or has damaged ones: their place is empty");
}

void declare(FigureOptions& figure, ArgumentList& arguments) {
  arguments.option("--out", "FILE", figure.out, "figure: .png, .pdf or .svg; repeatable", true);
  arguments.option(
      "--at", "PLACE", figure.at,
      "where the planes meet: X,Y,Z in mm, a landmark's name, or model, for its middle "
      "(default: the middle of the surfaces)");
  arguments.option("--landmarks", "FILE", figure.landmarks,
                   "landmarks for --at: CSV name,x_mm,y_mm,z_mm in LPS, or Slicer's .fcsv");
  arguments.option("--field-mm", "N", figure.field_mm,
                   "tissue that a panel's width shows (default: the surfaces and some room)");
  arguments.option("--window", "NAME", figure.window,
                   "greys: auto, soft-tissue, lung, bone, liver, vessels, or WIDTH,LEVEL");
  arguments.option("--dots-within-mm", "N", figure.dot_reach_mm,
                   "points this near to a plane are drawn in it (default 0.5)");
  arguments.option("--unit-mm", "N", figure.unit_mm,
                   "what one unit of the surfaces' files measures: 1000 for metres");
  declare(figure.volume, arguments);
  arguments.option("--style", "NAME", figure.style, "ieee (default), nature, elsevier or slides");
  arguments.option("--width-mm", "N", figure.width_mm,
                   "of the figure (default: the style's column; 183 for two)");
  arguments.option("--dpi", "N", figure.dots_per_inch, "of a PNG (default: the style's)");
  arguments.flag("--neurological", figure.neurological,
                 "patient's left on the left (default: radiological, left on the right)");
  declare(figure.paths, arguments);
  arguments.flag("--force", figure.force, "overwrite what is there");
}

}  // namespace softscope
