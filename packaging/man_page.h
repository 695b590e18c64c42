// packaging/man_page.h: help texts as man pages (roff).
#pragma once

#include <string>
#include <vector>

#include "packaging/command_list.h"

namespace softscope {

/// softscope.1: the list of commands, exit codes.
std::string overviewPage(const std::vector<ListedCommand>& commands, const std::string& version);

/// softscope-<command>.1: text of `softscope <command> --help`.
std::string commandPage(const ListedCommand& listed, const std::string& version);

}  // namespace softscope
