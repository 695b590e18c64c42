// apps/help_text.h: text of --help.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/argument_list.h"
#include "apps/command.h"

namespace softscope {

std::string overviewText(const std::vector<std::unique_ptr<Command>>& commands);
std::string helpText(const Command& command, const ArgumentList& arguments);

}  // namespace softscope
