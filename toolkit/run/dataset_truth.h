// toolkit/run/dataset_truth.h: ground truth in the form of a data set.
#pragma once

#include <string>

#include "io/sequences/dataset_form.h"

namespace softscope {

/// Names of the files and the command that reads them: `evaluate` reads groundtruth/ only. Empty
/// without files.
std::string describeTruth(const DatasetClip& clip);

}  // namespace softscope
