#include "apps/shared_arguments.h"

namespace softscope {

void declare(RecordPaths& paths, ArgumentList& arguments) {
  arguments.flag("--keep-paths", paths.keep,
                 "write full paths into the JSON instead of names of files and folders");
}

void declare(VolumeArguments& volume, ArgumentList& arguments) {
  arguments.option("--spacing", "X,Y,Z", volume.spacing,
                   "voxel spacing along i, j, k in mm, if missing in the file");
  arguments.flag("--allow-missing-slices", volume.allow_missing_slices,
                 "read a DICOM series with missing or damaged slices: they are left empty");
}

void declare(FigureOptions& figure, ArgumentList& arguments) {
  arguments.option("--out", "FILE", figure.out, "figure: .png, .pdf or .svg; repeatable", true);
  arguments.option("--at", "PLACE", figure.at,
                   "intersection of the planes: X,Y,Z in mm, the name of a landmark, or model for "
                   "its centre (default: centre of the surfaces)");
  arguments.option("--landmarks", "FILE", figure.landmarks,
                   "landmarks for --at: CSV name,x_mm,y_mm,z_mm in LPS, or Slicer's .fcsv");
  arguments.option("--field-mm", "N", figure.field_mm,
                   "field of view of a panel (default: the surfaces and a margin)");
  arguments.option("--window", "NAME", figure.window,
                   "grey window: auto, soft-tissue, lung, bone, liver, vessels, or WIDTH,LEVEL");
  arguments.option("--dots-within-mm", "N", figure.dot_reach_mm,
                   "distance within which points are drawn in a plane (default 0.5)");
  arguments.option(
      "--unit-mm", "N", figure.unit_mm,
      "mm per unit of the surface files: 1000 for metres (default: as they state, else 1)");
  declare(figure.volume, arguments);
  arguments.option("--style", "NAME", figure.style, "ieee (default), nature, elsevier or slides");
  arguments.option("--width-mm", "N", figure.width_mm,
                   "of the figure (default: column width of the style; 183 for two)");
  arguments.option("--dpi", "N", figure.dots_per_inch, "of a PNG (default: the style's)");
  arguments.flag("--neurological", figure.neurological,
                 "patient's left on the left (default: radiological, left on the right)");
  declare(figure.paths, arguments);
  arguments.flag("--force", figure.force, "overwrite existing files");
}

}  // namespace softscope
