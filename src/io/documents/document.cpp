#include "io/documents/document.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

/// Builds a Document in the order of the file, including duplicate keys.
class JsonReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit JsonReader(const std::string& name) : name_(name) {}

  Document document;

  bool null() override { return add({}); }
  bool boolean(bool value) override { return addText(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return addText(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return addText(std::to_string(value)); }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return addText(exactText(value));
  }
  bool string(string_t& value) override { return addText(value); }
  bool binary(binary_t& /*value*/) override { return false; }  // not part of JSON texts
  bool start_object(std::size_t /*size*/) override { return open(Document::Kind::kMap); }
  bool start_array(std::size_t /*size*/) override { return open(Document::Kind::kList); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    keys_.back() = value;
    return true;
  }
  bool parse_error(std::size_t byte, const std::string& /*token*/,
                   const nlohmann::json::exception& error) override {
    if (dynamic_cast<const nlohmann::json::out_of_range*>(&error) != nullptr)
      throw InputError(name_ + ": holds a number beyond all bounds. Export it again.");
    throw InputError(say(name_, ": not valid JSON from byte ", byte, " on. Export it again."));
  }

 private:
  bool addText(std::string text) {
    Document value;
    value.text = std::move(text);
    return add(std::move(value));
  }
  bool add(Document value) {
    if (open_.empty())
      document = std::move(value);
    else if (open_.back().kind == Document::Kind::kMap)
      open_.back().members.emplace_back(keys_.back(), std::move(value));
    else
      open_.back().items.push_back(std::move(value));
    return true;
  }
  bool open(Document::Kind kind) {
    if (int(open_.size()) > kDeepestNesting)
      throw InputError(name_ + ": nested too deeply to be a calibration.");
    open_.emplace_back().kind = kind;
    keys_.emplace_back();
    return true;
  }
  bool close() {
    Document done = std::move(open_.back());
    open_.pop_back();
    keys_.pop_back();
    return add(std::move(done));
  }

  const std::string& name_;
  std::vector<Document> open_;     // open maps and lists, from the outermost to the innermost
  std::vector<std::string> keys_;  // current key in each of them
};

bool isSame(const Document& a, const Document& b) {
  return a.kind == b.kind && a.text == b.text &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), isSame) &&
         std::equal(a.members.begin(), a.members.end(), b.members.begin(), b.members.end(),
                    [](const auto& one, const auto& other) {
                      return one.first == other.first && isSame(one.second, other.second);
                    });
}

}  // namespace

const Document* Document::find(std::string_view key) const {
  for (const auto& [name, value] : members)
    if (name == key) return &value;
  return nullptr;
}

void requireUniqueKeys(const Document& document, const std::string& name) {
  std::map<std::string_view, const Document*> first;
  for (const auto& [key, value] : document.members) {
    requireUniqueKeys(value, name);
    const auto [earlier, is_new] = first.emplace(key, &value);
    if (!is_new && !isSame(*earlier->second, value))
      throw InputError(say(name, ": ", excerpt(key),
                           " occurs twice with different values. Delete the wrong one."));
  }
  for (const Document& item : document.items) requireUniqueKeys(item, name);
}

Document parseJson(std::string_view text, const std::string& name) {
  JsonReader reader(name);
  nlohmann::json::sax_parse(text, &reader);
  requireUniqueKeys(reader.document, name);
  return std::move(reader.document);
}

Document parseDocument(std::string_view text, const std::string& name) {
  const std::string_view content = trimmed(text);
  if (!content.empty() && content.front() == '<') return parseXml(text, name);
  if (!content.empty() && content.front() == '{') return parseJson(text, name);
  return parseYaml(text, name);
}

}  // namespace softscope
