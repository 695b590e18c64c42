// include/softscope/softscope.h: all headers of the library.
#pragma once

#include "softscope/calibration.h"
#include "softscope/compare.h"
#include "softscope/depth.h"
#include "softscope/evaluate.h"
#include "softscope/figure.h"
#include "softscope/frame.h"
#include "softscope/options.h"
#include "softscope/reconstructor.h"
#include "softscope/report.h"
#include "softscope/run.h"
#include "softscope/sequence.h"
#include "softscope/simulate.h"
