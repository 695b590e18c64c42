// apps/program.h: the program without main().
#pragma once

#include <string>
#include <vector>

namespace softscope {

/// Runs one command line without the program name;
/// prints failures to stderr. Returns the exit code.
int runProgram(const std::vector<std::string>& words);

}  // namespace softscope
