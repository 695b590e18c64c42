// src/io/documents/yaml_document.cpp: subset of YAML written by OpenCV, ROS and Python.
#include <algorithm>

#include "core/error.h"
#include "io/documents/document.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

struct Line {
  int number = 0;          // from 1
  std::size_t indent = 0;  // number of blanks before the text
  std::string_view text;   // without comment and surrounding blanks
};

/// Removes a comment: # at the start or after a blank, outside of quotes.
std::string_view withoutComment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
      return line.substr(0, i);
    }
  }
  return line;
}

std::vector<Line> contentLines(std::string_view text) {
  std::vector<Line> lines;
  int number = 0;
  for (const std::string_view whole : linesOf(text)) {
    ++number;
    const std::string_view line = withoutComment(whole);
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '%' || content == "---" || content == "...") continue;
    lines.push_back({number, static_cast<std::size_t>(content.data() - line.data()), content});
  }
  return lines;
}

/// Skips a tag such as !!opencv-matrix.
std::string_view withoutTag(std::string_view value) {
  if (value.empty() || value.front() != '!') return value;
  const std::size_t end = value.find_first_of(" \t");
  return end == std::string_view::npos ? std::string_view{} : trimmed(value.substr(end));
}

std::string unquoted(std::string_view value) {
  if (value.size() >= 2 && (value.front() == '"' || value.front() == '\'') &&
      value.back() == value.front())
    return std::string(value.substr(1, value.size() - 2));
  return std::string(value);
}

/// Position of the colon of `key: value`; npos if absent.
std::size_t colonOf(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == ':' && (i + 1 == text.size() || text[i + 1] == ' ' || text[i + 1] == '\t')) {
      return i;
    }
  }
  return std::string_view::npos;
}

/// Parser of bracketed content: [1, 2] or {a: 1}, possibly over several lines.
class FlowParser {
 public:
  FlowParser(std::string_view text, std::string name, int line)
      : text_(text), name_(std::move(name)), line_(line) {}

  Document parse() {
    Document out = value(0);
    skipBlanks();
    if (next_ != text_.size()) fail("text after the closing bracket");
    return out;
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw InputError(say(name_, ": line ", line_, ": ", what, ". Mend or export it again."));
  }
  void skipBlanks() {
    while (next_ < text_.size() && trimmed(text_.substr(next_, 1)).empty()) ++next_;
  }
  bool take(char c) {
    skipBlanks();
    if (next_ >= text_.size() || text_[next_] != c) return false;
    ++next_;
    return true;
  }
  Document value(int depth) {
    if (depth > kDeepestNesting) fail("nested too deeply");
    if (take('[')) return list(depth);
    if (take('{')) return map(depth);
    Document out;
    out.text = word(",]}");
    return out;
  }
  Document list(int depth) {
    Document out;
    out.kind = Document::Kind::kList;
    while (!take(']')) {
      out.items.push_back(value(depth + 1));
      if (take(']')) break;
      if (!take(',')) fail("`,` or `]` is missing in a list");
    }
    return out;
  }
  Document map(int depth) {
    Document out;
    out.kind = Document::Kind::kMap;
    while (!take('}')) {
      std::string key = word(":,}");
      if (!take(':')) fail("`:` is missing in a map");
      out.members.emplace_back(std::move(key), value(depth + 1));
      if (take('}')) break;
      if (!take(',')) fail("`,` or `}` is missing in a map");
    }
    return out;
  }
  std::string word(std::string_view stops) {
    skipBlanks();
    const std::size_t end = std::min(text_.find_first_of(stops, next_), text_.size());
    const std::string_view found = trimmed(text_.substr(next_, end - next_));
    next_ = end;
    return unquoted(withoutTag(found));
  }

  std::string_view text_;
  std::string name_;
  int line_;
  std::size_t next_ = 0;
};

class BlockParser {
 public:
  BlockParser(std::string_view text, std::string name)
      : lines_(contentLines(text)), name_(std::move(name)) {}

  Document parse() {
    if (lines_.empty()) throw InputError(name_ + ": holds no data. Export it again.");
    Document out = block(0);
    if (next_ != lines_.size()) fail("its indentation fits nothing above");
    return out;
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    const Line& line = lines_[std::min(next_, lines_.size() - 1)];
    throw InputError(say(name_, ": line ", line.number, ", ", excerpt(line.text), ": ", what,
                         ". Mend or export it again."));
  }
  bool more() const { return next_ < lines_.size(); }
  static bool isItem(const Line& line) {
    return line.text == "-" || line.text.substr(0, 2) == "- ";
  }

  Document block(int depth) {
    if (depth > kDeepestNesting) fail("nested too deeply");
    if (isItem(lines_[next_])) return list(depth);
    if (colonOf(lines_[next_].text) != std::string_view::npos) return map(depth);
    return value(lines_[next_].text);
  }

  Document list(int depth) {
    Document out;
    out.kind = Document::Kind::kList;
    const std::size_t indent = lines_[next_].indent;
    while (more() && lines_[next_].indent == indent && isItem(lines_[next_])) {
      Line& line = lines_[next_];
      const std::string_view rest = trimmed(line.text.substr(1));
      if (rest.empty()) {
        ++next_;
        out.items.push_back(below(indent, depth));
      } else {  // the dash is followed by an indented block
        line.indent += static_cast<std::size_t>(rest.data() - line.text.data());
        line.text = rest;
        out.items.push_back(block(depth + 1));
      }
    }
    return out;
  }

  Document map(int depth) {
    Document out;
    out.kind = Document::Kind::kMap;
    const std::size_t indent = lines_[next_].indent;
    while (more() && lines_[next_].indent == indent && !isItem(lines_[next_])) {
      const std::string_view text = lines_[next_].text;
      const std::size_t colon = colonOf(text);
      if (colon == std::string_view::npos) fail("`key: value` is expected here");
      std::string key = unquoted(trimmed(text.substr(0, colon)));
      const std::string_view rest = withoutTag(trimmed(text.substr(colon + 1)));
      if (rest.empty()) {
        ++next_;
        const bool list_follows = more() && lines_[next_].indent == indent && isItem(lines_[next_]);
        out.members.emplace_back(std::move(key),
                                 list_follows ? list(depth + 1) : below(indent, depth));
      } else {
        out.members.emplace_back(std::move(key), value(rest));
      }
    }
    return out;
  }

  /// Block with more indentation than `indent`, or empty.
  Document below(std::size_t indent, int depth) {
    if (!more() || lines_[next_].indent <= indent) return {};
    return block(depth + 1);
  }

  /// A word, or brackets that may continue on the next lines.
  Document value(std::string_view first) {
    const int line = lines_[next_].number;
    ++next_;
    Document out;
    if (first.front() != '[' && first.front() != '{') {
      out.text = unquoted(first);
      return out;
    }
    std::string text(first);
    auto open = bracketBalance(first);
    while (open > 0 && more()) {
      open += bracketBalance(lines_[next_].text);
      text += ' ';
      text += lines_[next_++].text;
    }
    return FlowParser(text, name_, line).parse();
  }

  static long bracketBalance(std::string_view text) {
    const auto count = [&](char c) { return std::count(text.begin(), text.end(), c); };
    return count('[') + count('{') - count(']') - count('}');
  }

  std::vector<Line> lines_;
  std::string name_;
  std::size_t next_ = 0;
};

}  // namespace

Document parseYaml(std::string_view text, const std::string& name) {
  Document document = BlockParser(text, name).parse();
  requireUniqueKeys(document, name);
  return document;
}

}  // namespace softscope
