// apps/command_line.h: from argv to a command that is ready to run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"

namespace softscope {

struct ParsedLine {
  Command* command = nullptr;  // null where only `text` is to be printed
  std::string text;            // help or version
};

/// Throws OptionError on what can't be understood, with the nearest name where there is one.
ParsedLine parseCommandLine(const std::vector<std::string>& words,
                            const std::vector<std::unique_ptr<Command>>& commands);

}  // namespace softscope
