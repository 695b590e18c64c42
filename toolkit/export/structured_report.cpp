// toolkit/export/structured_report.cpp: conversion of the record to content items.
#include "toolkit/export/structured_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <sstream>
#include <vector>

#include "io/files/file_hash.h"
#include "io/text/message.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

struct Code {
  std::string value, scheme, meaning;
};

const Code kNoUnit{"1", "UCUM", "no units"};
constexpr std::size_t kLongestMeaning = 64;  // characters of LO
const char* const kOwnScheme = "99SOFTSCOPE";

/// Code of DICOM itself (PS3.16, annex D).
Code dcm(const char* value, const char* meaning) { return {value, "DCM", meaning}; }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">";
}

std::string codeXml(const Code& code) {
  return element("value", escaped(code.value)) +
         element("scheme", element("designator", code.scheme)) +
         element("meaning", escaped(code.meaning));
}

/// Content item: relationship to its parent, concept, content.
std::string item(const std::string& kind, const std::string& relationship, const Code& concept_name,
                 const std::string& rest) {
  return element(kind, element("relationship", relationship) +
                           element("concept", codeXml(concept_name)) + rest) +
         "\n";
}

std::string container(const std::string& relationship, const char* template_id,
                      const Code& concept_name, const std::string& content) {
  return "<container flag=\"SEPARATE\">" +
         (relationship.empty() ? "" : element("relationship", relationship)) +
         (*template_id == '\0'
              ? ""
              : element("template", element("resource", "DCMR") + element("id", template_id))) +
         element("concept", codeXml(concept_name)) + "\n" + content + "</container>\n";
}

bool endsWith(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// Unit from the suffix of the key: docs/evaluation.md.
bool unitOfKey(const std::string& key, Code* unit) {
  static const std::vector<std::pair<const char*, Code>> kUnits{
      {"_mm_per_s", {"mm/s", "UCUM", "mm/s"}},
      {"_mm_per_frame", {"mm/{frame}", "UCUM", "mm per frame"}},
      {"_deg_per_frame", {"deg/{frame}", "UCUM", "degrees per frame"}},
      {"_mm2", {"mm2", "UCUM", "square mm"}},
      {"_1mm", kNoUnit},  // share within 1 mm
      {"_mm", {"mm", "UCUM", "mm"}},
      {"_px", {"{pixels}", "UCUM", "pixels"}},
      {"_deg", {"deg", "UCUM", "degrees"}},
      {"_percent", {"%", "UCUM", "percent"}},
      {"_db", {"dB", "UCUM", "decibel"}},
      {"_ms", {"ms", "UCUM", "ms"}},
      {"_s", {"s", "UCUM", "s"}},
      {"_share", kNoUnit},
      {"_p", kNoUnit}};
  if (key == "n" || endsWith(key, "count")) {
    *unit = kNoUnit;
    return true;
  }
  for (const auto& [ending, code] : kUnits)
    if (endsWith("_" + key, ending)) {
      *unit = code;
      return true;
    }
  return false;
}

/// The last key of the path with a unit: the SD in `mean_mm.sd` is in mm.
Code unitOfPath(const std::vector<std::string>& path) {
  Code unit = kNoUnit;
  for (auto key = path.rbegin(); key != path.rend(); ++key)
    if (unitOfKey(*key, &unit)) break;
  return unit;
}

/// Modifier for the derivation of a value (CID 7464), or empty.
std::string derivationXml(const std::string& key) {
  static const std::vector<std::pair<const char*, Code>> kDerivations{
      {"mean", {"373098007", "SCT", "Mean"}},
      {"sd", {"386136009", "SCT", "Standard Deviation"}},
      {"median", {"373099004", "SCT", "Median"}},
      {"min", {"255605001", "SCT", "Minimum"}},
      {"max", {"56851009", "SCT", "Maximum"}}};
  const std::string first = key.substr(0, key.find('_'));
  for (const auto& [word, code] : kDerivations)
    if (first == word)
      return item("code", "HAS CONCEPT MOD", dcm("121401", "Derivation"), codeXml(code));
  return "";
}

/// A DICOM decimal has at most sixteen bytes.
std::string decimalText(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

/// UID of 128 bits (ISO/IEC 9834-8), deterministic in the text.
std::string uidOf(const std::string& text) {
  const std::string hex = sha256OfBytes(text).substr(0, 32);
  std::string decimal;  // least significant digit first
  for (const char c : hex) {
    int carry = c <= '9' ? c - '0' : c - 'a' + 10;
    for (char& digit : decimal) {
      const int sum = 16 * (digit - '0') + carry;
      digit = static_cast<char>('0' + sum % 10);
      carry = sum / 10;
    }
    for (; carry > 0; carry /= 10) decimal += static_cast<char>('0' + carry % 10);
  }
  std::reverse(decimal.begin(), decimal.end());
  return "2.25." + (decimal.empty() ? "0" : decimal);
}

class Measurements {
 public:
  int count() const { return count_; }

  /// Measurement group; `identity` distinguishes groups of the same name.
  std::string group(const std::string& name, const std::string& identity, const Json& numbers) {
    std::string content = item("text", "HAS OBS CONTEXT", dcm("112039", "Tracking Identifier"),
                               element("value", escaped(name)));
    content += item("uidref", "HAS OBS CONTEXT", dcm("112040", "Tracking Unique Identifier"),
                    element("value", uidOf(identity + "/" + name)));
    std::vector<std::string> path;
    addAll(numbers, &path, &content);
    return container("CONTAINS", "1501", dcm("125007", "Measurement Group"), content);
  }

 private:
  int count_ = 0;

  void addAll(const Json& part, std::vector<std::string>* path, std::string* content) {
    for (const auto& [key, value] : part.items()) {
      if (key == "schema_version" || key == "error_histogram") continue;
      path->push_back(key);
      if (value.is_object()) addAll(value, path, content);
      if (value.is_number() && std::isfinite(value.get<double>()))
        *content += number(*path, value.get<double>());
      path->pop_back();
    }
  }

  std::string number(const std::vector<std::string>& path, double value) {
    ++count_;
    std::string code, meaning;
    for (const std::string& key : path) {
      code += (code.empty() ? "" : ".") + key;
      meaning += (meaning.empty() ? "" : ", ") + key;
    }
    std::replace(meaning.begin(), meaning.end(), '_', ' ');
    if (meaning.size() > kLongestMeaning)
      meaning = meaning.substr(meaning.size() - kLongestMeaning);
    return item("num", "CONTAINS", {code, kOwnScheme, meaning},
                derivationXml(path.back()) + element("value", decimalText(value)) +
                    element("unit", codeXml(unitOfPath(path))));
  }
};

/// Language, observer (this program) and procedure, required by TID 1500 before measurements.
std::string contextXml() {
  return item("code", "HAS CONCEPT MOD", dcm("121049", "Language of Content Item and Descendants"),
              codeXml({"en", "RFC5646", "English"})) +
         item("code", "HAS OBS CONTEXT", dcm("121005", "Observer Type"),
              codeXml(dcm("121007", "Device"))) +
         item("uidref", "HAS OBS CONTEXT", dcm("121012", "Device Observer UID"),
              element("value", uidOf("softscope " + versionText()))) +
         item("text", "HAS OBS CONTEXT", dcm("121013", "Device Observer Name"),
              element("value", "softscope " + versionText())) +
         item("code", "HAS CONCEPT MOD", dcm("121058", "Procedure reported"),
              codeXml({"423827005", "SCT", "Endoscopy"}));
}

std::string nowText(const char* form) {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 16> text{};
  std::strftime(text.data(), text.size(), form, &parts);
  return text.data();
}

/// Family^Given^Middle^Prefix^Suffix, one element per part.
std::string personXml(const std::string& name) {
  std::istringstream parts(name);
  std::map<std::string, std::string> of;
  for (const char* part : {"last", "first", "middle", "prefix", "suffix"})
    std::getline(parts, of[part], '^');
  std::string xml;
  for (const char* part : {"prefix", "first", "middle", "last", "suffix"})
    if (!of[part].empty()) xml += element(part, escaped(of[part]));
  return element("name", xml);
}

/// Document without its content; the UIDs are placeholders.
std::string headXml(const DicomTexts& texts) {
  const std::string uid = " uid=\"" + uidOf("") + "\"";
  const std::string series =
      element("number", "1") +
      (texts.title.empty() ? "" : element("description", escaped(texts.title)));
  return "<sopclass uid=\"1.2.840.10008.5.1.4.1.1.88.33\">ComprehensiveSR</sopclass>"
         "<charset>UTF-8</charset><modality>SR</modality>" +
         element("device", element("manufacturer", "softscope") + element("model", "softscope") +
                               element("version", versionText())) +
         element("patient",
                 element("id", escaped(texts.patient_id)) + personXml(texts.patient_name)) +
         "<study" + uid + "></study><series" + uid + ">" + series + "</series><instance" + uid +
         ">" + element("number", "1") + "</instance><coding><scheme designator=\"" + kOwnScheme +
         "\">" + element("name", "Paths of numbers in softscope's records") +
         "</scheme></coding>\n";
}

}  // namespace

StructuredReport structuredReport(const Json& metrics, const DicomTexts& texts) {
  const std::string hash = metrics.value("content_sha256", "");
  Measurements measurements;
  std::string groups;
  for (const Json& one : metrics.at("cases"))
    groups +=
        measurements.group(one.value("name", "case"), hash, one.value("record", Json::object()));
  if (metrics.contains("cohort"))
    groups += measurements.group("All cases", hash, metrics["cohort"]);
  const std::string content =
      contextXml() + container("CONTAINS", "", dcm("126010", "Imaging Measurements"), groups) +
      item("text", "CONTAINS", dcm("121106", "Comment"),
           element("value",
                   "Research use only, not for diagnosis. SHA-256 of the report's content: " +
                       (hash.empty() ? "unknown" : escaped(hash))));
  const std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<report type=\"Comprehensive SR\" "
      "xmlns=\"http://dicom.offis.de/dcmsr\">\n" +
      headXml(texts) +
      "<document><completion flag=\"COMPLETE\"/><verification flag=\"UNVERIFIED\"/><content>" +
      element("date", nowText("%Y-%m-%d")) + element("time", nowText("%H:%M:%S")) +
      container("", "1500", dcm("126000", "Imaging Measurement Report"), content) +
      "</content></document></report>\n";
  return {xml, measurements.count()};
}

}  // namespace softscope
