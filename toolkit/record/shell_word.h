// toolkit/record/shell_word.h: an argument as it must be typed.
#pragma once

#include <string>

namespace softscope {

/// `word` as a POSIX shell reads it back: in single quotes where it holds anything that the shell
/// would not take for itself.
std::string shellWord(const std::string& word);

}  // namespace softscope
