// toolkit/record/fact_sheet.h: facts of a result, as lines of text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace softscope {

class FactSheet {
 public:
  using Json = nlohmann::ordered_json;

  explicit FactSheet(std::string title) : title_(std::move(title)) {}

  /// `key` is the JSON name with its unit; dots nest it ("left.focal_x_px").
  void add(const std::string& label, const std::string& text, const std::string& key, Json value);
  /// Fact with equal text and value.
  void add(const std::string& label, const std::string& key, const std::string& text) {
    add(label, text, key, text);
  }
  void add(const std::string& label, const std::string& key, int value) {
    add(label, std::to_string(value), key, value);
  }
  /// For the text only.
  void addLine(const std::string& label, const std::string& text) {
    lines_.emplace_back(label, text);
  }
  /// For JSON only.
  void addQuietly(const std::string& key, Json value);
  void warn(const std::string& text) { warnings_.push_back(text); }
  void missing(const std::string& text) { missing_.push_back(text); }
  /// Problem that prevents the use of the input; `softscope info` then ends with exit code 3.
  void fail(const std::string& text) { problems_.push_back(text); }
  bool hasProblems() const { return !problems_.empty(); }

  std::string text() const;
  /// schema_version first; "problems", "warnings" and "missing" are always present.
  Json json() const;

 private:
  std::string title_;
  std::vector<std::pair<std::string, std::string>> lines_;
  Json json_ = Json::object();
  std::vector<std::string> warnings_, missing_, problems_;
};

/// Number with `decimals` decimals.
std::string fixed(double value, int decimals);

}  // namespace softscope
