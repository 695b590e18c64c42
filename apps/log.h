// apps/log.h: log level of stderr.
#pragma once

#include "apps/common_options.h"

namespace softscope {

/// Sends messages of spdlog's default logger to stderr: "warning: …".
/// Colours and overwriting of the progress bar only if stderr is a terminal.
void setUpLog(const CommonOptions& common);

bool stderrIsTerminal();

}  // namespace softscope
