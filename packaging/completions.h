// packaging/completions.h: completions of commands and options for three shells.
#pragma once

#include <string>
#include <vector>

#include "packaging/command_list.h"

namespace softscope {

std::string bashCompletion(const std::vector<ListedCommand>& commands);
std::string zshCompletion(const std::vector<ListedCommand>& commands);
std::string fishCompletion(const std::vector<ListedCommand>& commands);

}  // namespace softscope
