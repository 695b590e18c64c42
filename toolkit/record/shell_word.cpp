// toolkit/record/shell_word.cpp: single quotes and their escape.
#include "toolkit/record/shell_word.h"

#include <algorithm>
#include <cctype>

namespace softscope {

std::string shellWord(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string("_-./,:=+@%").find(char(c)) != std::string::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace softscope
