// apps/program.h: the whole program but for main().
#pragma once

#include <string>
#include <vector>

namespace softscope {

/// Runs one command line, without the program's name; tells failures on stderr. Returns the exit
/// code.
int runProgram(const std::vector<std::string>& words);

}  // namespace softscope
