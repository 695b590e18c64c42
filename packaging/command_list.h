// packaging/command_list.h: commands with all their options, for man pages and
// completions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"

namespace softscope {

struct ListedCommand {
  std::unique_ptr<Command> command;
  ArgumentList arguments;                 // those of the command, then the common ones
  std::vector<std::string> setting_keys;  // of --set; may be empty
};

/// All commands, in the order of `softscope --help`.
std::vector<ListedCommand> listCommands();

/// Kind of an option value or a positional argument.
enum class ValueKind { kNone, kWord, kFile, kFolder, kSetting };

ValueKind valueKind(const Argument& argument);

}  // namespace softscope
