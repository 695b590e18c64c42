// packaging/command_list.h: commands with all their options, as man pages and completions need
// them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"

namespace softscope {

struct ListedCommand {
  std::unique_ptr<Command> command;
  ArgumentList arguments;                 // the command's own, then the common ones
  std::vector<std::string> setting_keys;  // of --set; empty where there is none
};

/// All commands, in the order of `softscope --help`.
std::vector<ListedCommand> listCommands();

/// What may follow an option, or stand in the place of a positional argument.
enum class ValueKind { kNone, kWord, kFile, kFolder, kSetting };

ValueKind valueKind(const Argument& argument);

}  // namespace softscope
