// include/softscope/error.h: exceptions; installed as a copy of the file that it includes.
#pragma once

#include "core/error.h"  // softscope::Error, OptionError, InputError, BackendError
