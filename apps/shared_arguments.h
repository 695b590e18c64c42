// apps/shared_arguments.h: arguments common to several commands.
#pragma once

#include "apps/argument_list.h"
#include "toolkit/figures/figure_options.h"
#include "toolkit/figures/volume_arguments.h"
#include "toolkit/record/record_paths.h"

namespace softscope {

/// --keep-paths, for commands that write a record.
void declare(RecordPaths& paths, ArgumentList& arguments);

/// --spacing, --allow-missing-slices.
void declare(VolumeArguments& volume, ArgumentList& arguments);

/// Common options of `slice` and `figure`.
void declare(FigureOptions& figure, ArgumentList& arguments);

}  // namespace softscope
