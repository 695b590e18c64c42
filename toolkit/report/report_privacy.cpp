// toolkit/report/report_privacy.cpp: known paths by their role, others by pattern.
#include "toolkit/report/report_privacy.h"

#include <cctype>

#include "toolkit/record/path_words.h"
#include "toolkit/report/report_case.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

bool isWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Replaces `what` as a separate word; a plain word ("run")
/// only before a colon or slash, where it is a path.
void replaceInput(const std::string& what, const std::string& role, std::string& text) {
  if (what.empty()) return;
  const bool plain = what.find_first_of("/\\.") == std::string::npos;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos;) {
    const std::size_t end = at + what.size();
    const char before = at == 0 ? ' ' : text[at - 1], after = end < text.size() ? text[end] : ' ';
    const bool alone = !isWordLetter(before) && !isWordLetter(after);
    if (!alone || (plain && after != ':' && after != '/')) {
      at = end;
      continue;
    }
    text.replace(at, what.size() + (after == '/' ? 1 : 0), after == '/' ? role + ": " : role);
    at += role.size();
  }
}

Json cleaned(const Json& part, const Json& record) {
  if (part.is_string()) return withoutPaths(part.get<std::string>(), record);
  Json result = part;
  if (part.is_structured())
    for (const auto& [key, value] : part.items())
      (part.is_array() ? result[std::stoul(key)] : result[key]) = cleaned(value, record);
  return result;
}

}  // namespace

std::string withoutPaths(std::string text, const Json& record) {
  using Role = std::pair<const char*, const char*>;
  for (const auto& [key, role] : {Role{"inputs.run", "the run"}, Role{"inputs.test", "the model"},
                                  Role{"inputs.reference", "the reference"}}) {
    replaceInput(textAt(record, key), role, text);
  }
  return replacePaths(text, [](const std::string&) { return std::string("[file]"); });
}

Json withoutPaths(const Json& record) {
  Json result = record;
  result.erase("inputs");
  return cleaned(result, record);
}

}  // namespace softscope
