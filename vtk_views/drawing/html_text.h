// vtk_views/drawing/html_text.h: escaping of text and bytes for HTML.
#pragma once

#include <string>
#include <string_view>

namespace softscope {

/// For text and quoted attribute values: & < > " ' as
/// entities; control characters and invalid UTF-8 as U+FFFD.
std::string htmlEscaped(std::string_view text);

/// Replaces invalid UTF-8 by U+FFFD.
std::string validUtf8(std::string_view text);

/// For JSON in a script element: < > & and the line separators of JavaScript as \u escapes.
std::string scriptSafe(std::string_view json);

/// JSON string with its quotes; invalid UTF-8 as U+FFFD.
std::string jsonQuoted(std::string_view text);

std::string base64(std::string_view bytes);

}  // namespace softscope
