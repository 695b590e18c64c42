// apps/command_line.h: conversion of argv to a command.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"

namespace softscope {

struct ParsedLine {
  Command* command = nullptr;  // null if only `text` is printed
  std::string text;            // help or version
};

/// Throws OptionError for invalid arguments, with the nearest name if there is one.
ParsedLine parseCommandLine(const std::vector<std::string>& words,
                            const std::vector<std::unique_ptr<Command>>& commands);

}  // namespace softscope
