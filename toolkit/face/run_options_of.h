// toolkit/face/run_options_of.h: options of the public face to those of the pipeline.
#pragma once

#include "pipeline/run_options.h"
#include "softscope/options.h"

namespace softscope::api {

/// Throws OptionError.
RunOptions runOptionsOf(const Options& options);
DepthOptions depthOptionsOf(const Options& options);

}  // namespace softscope::api
