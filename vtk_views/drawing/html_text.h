// vtk_views/drawing/html_text.h: escaping of text and bytes for HTML.
#pragma once

#include <string>
#include <string_view>

namespace softscope {

/// For text and attribute values between quotes: & < > " ' as entities; control characters and
/// bytes that are no UTF-8 as U+FFFD.
std::string htmlEscaped(std::string_view text);

/// Bytes that are no UTF-8 as U+FFFD, all else as it is.
std::string validUtf8(std::string_view text);

/// For JSON inside a script element: < > & and the line separators of JavaScript as \u escapes.
std::string scriptSafe(std::string_view json);

/// As a JSON string, with its quotes; bytes that are no UTF-8 as U+FFFD.
std::string jsonQuoted(std::string_view text);

std::string base64(std::string_view bytes);

}  // namespace softscope
