// toolkit/record/shell_word.h: quoting of an argument for a shell.
#pragma once

#include <string>

namespace softscope {

/// `word` as a POSIX shell parses it back: in
/// single quotes if it contains special characters.
std::string shellWord(const std::string& word);

}  // namespace softscope
