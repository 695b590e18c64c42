// toolkit/face/run_options_of.h: conversion of options of the public interface to the pipeline.
#pragma once

#include "pipeline/options/run_options.h"
#include "softscope/options.h"

namespace softscope::api {

/// Throws OptionError.
RunOptions runOptionsOf(const Options& options);
DepthOptions depthOptionsOf(const Options& options);

}  // namespace softscope::api
