// include/softscope/error.h: exceptions; installed as a copy of the included file.
#pragma once

#include "core/error.h"  // softscope::Error, OptionError, InputError, BackendError
