// src/io/documents/xml_document.cpp: subset of XML written by OpenCV.
#include <algorithm>

#include "core/error.h"
#include "io/documents/document.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

class XmlParser {
 public:
  XmlParser(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  Document parse() {
    skipProlog();
    const Tag root = tag();
    if (root.kind == Tag::Kind::kClosing) fail("a closing tag without its opening one");
    return root.kind == Tag::Kind::kEmpty ? Document{} : content(root.name, 0);
  }

 private:
  struct Tag {
    enum class Kind { kOpening, kClosing, kEmpty };
    Kind kind = Kind::kOpening;
    std::string_view name;
  };

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(next_), '\n');
    throw InputError(say(name_, ": line ", line, ": ", what, ". Mend or export it again."));
  }
  bool startsWith(std::string_view head) const { return text_.substr(next_, head.size()) == head; }
  void skipPast(std::string_view end) {
    const std::size_t at = text_.find(end, next_);
    if (at == std::string_view::npos) fail(say("`", end, "` is missing"));
    next_ = at + end.size();
  }
  void skipBlanks() {
    while (next_ < text_.size() && trimmed(text_.substr(next_, 1)).empty()) ++next_;
  }
  void skipProlog() {
    for (skipBlanks();; skipBlanks()) {
      if (startsWith("<?")) {
        skipPast("?>");
      } else if (startsWith("<!--")) {
        skipPast("-->");
      } else if (startsWith("<!")) {
        skipPast(">");
      } else {
        return;
      }
    }
  }
  Tag tag() {
    if (!startsWith("<")) fail("`<` is expected here");
    const std::size_t begin = next_ + 1;
    skipPast(">");
    std::string_view inside = text_.substr(begin, next_ - 1 - begin);
    Tag out;
    if (!inside.empty() && inside.front() == '/') {
      out.kind = Tag::Kind::kClosing;
      inside.remove_prefix(1);
    } else if (!inside.empty() && inside.back() == '/') {
      out.kind = Tag::Kind::kEmpty;
      inside.remove_suffix(1);
    }
    out.name = inside.substr(0, inside.find_first_of(" \t\r\n"));
    if (out.name.empty()) fail("a tag without a name");
    return out;
  }

  /// Content between <name> and </name>.
  Document content(std::string_view name, int depth) {
    if (depth > kDeepestNesting) fail("nested too deeply");
    Document out;
    while (true) {
      const std::size_t text_end = std::min(text_.find('<', next_), text_.size());
      out.text += trimmed(text_.substr(next_, text_end - next_));
      next_ = text_end;
      if (next_ == text_.size()) fail(say("</", name, "> is missing"));
      if (startsWith("<!--")) {
        skipPast("-->");
        continue;
      }
      const Tag child = tag();
      if (child.kind == Tag::Kind::kClosing) {
        if (child.name != name) fail(say("</", name, "> is expected here"));
        break;
      }
      add(out, child.name,
          child.kind == Tag::Kind::kEmpty ? Document{} : content(child.name, depth + 1));
    }
    return out;
  }

  /// `_` is OpenCV's name of list items.
  static void add(Document& parent, std::string_view name, Document child) {
    if (name == "_") {
      parent.kind = Document::Kind::kList;
      parent.items.push_back(std::move(child));
    } else {
      parent.kind = Document::Kind::kMap;
      parent.members.emplace_back(std::string(name), std::move(child));
    }
  }

  std::string_view text_;
  std::string name_;
  std::size_t next_ = 0;
};

}  // namespace

Document parseXml(std::string_view text, const std::string& name) {
  Document document = XmlParser(text, name).parse();
  requireUniqueKeys(document, name);
  return document;
}

}  // namespace softscope
