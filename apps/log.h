// apps/log.h: log level of stderr.
#pragma once

#include "apps/common_options.h"

namespace softscope {

/// From here on spdlog's default logger writes to stderr: "warning: …". Colours and overwriting of
/// a progress bar's line only where stderr is a terminal.
void setUpLog(const CommonOptions& common);

bool stderrIsTerminal();

}  // namespace softscope
