#include "io/calibrations/lens_model.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

// Without capitals, blanks, hyphens and underscores.
constexpr std::array<std::string_view, 12> kPinholeModels = {
    "pinhole",       "plumbbob", "rational",       "rationalpolynomial",
    "radtan",        "brown",    "brownconrady",   "radialtangential",
    "opencvpinhole", "opencv",   "opencvrational", "none"};
constexpr std::array<std::string_view, 10> kFisheyeParts = {
    "fisheye", "equidist", "equisolid", "kannala",    "omnidir",
    "unified", "ftheta",   "ocam",      "scaramuzza", "doublesphere"};
constexpr std::array<std::string_view, 8> kFisheyeNames = {"kb",  "kb4", "kb8", "mei",
                                                           "ucm", "ds",  "fov", "omni"};

std::string lettersOf(std::string_view text) {
  std::string out = lowerCase(text);
  const auto isOther = [](char c) { return !(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9'); };
  out.erase(std::remove_if(out.begin(), out.end(), isOther), out.end());
  return out;
}

template <std::size_t n>
bool hasPart(const std::string& text, const std::array<std::string_view, n>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return text.find(part) != std::string::npos; });
}

template <std::size_t n>
bool isAmong(const std::string& text, const std::array<std::string_view, n>& names) {
  return std::find(names.begin(), names.end(), text) != names.end();
}

bool namesFisheye(const std::string& letters) {
  return hasPart(letters, kFisheyeParts) || isAmong(letters, kFisheyeNames);
}

bool isReadable(const std::string& key, std::string_view value) {
  const std::string letters = lettersOf(value);
  if (hasPart<1>(key, {"fisheye"}))
    return isAmong<6>(letters, {"", "0", "false", "no", "off", "none"});
  if (hasPart<1>(key, {"distortion"}) && hasPart<2>(key, {"model", "type"}))
    return isAmong(letters, kPinholeModels);
  if (hasPart<5>(key, {"model", "type", "lens", "projection", "distortion"}))
    return !namesFisheye(letters);
  return true;
}

}  // namespace

void requirePinholeLens(std::string_view key, std::string_view value, const std::string& name) {
  if (isReadable(lettersOf(key), value)) return;
  throw InputError(say(name, ": ", printable(key), " is ", excerpt(value),
                       ", but plumb_bob or rational_polynomial is expected; fisheye models are not "
                       "read. Calibrate with the pinhole model (`softscope calibrate`)."));
}

void requirePinholeLens(const Document& document, const std::string& name) {
  for (const auto& [key, value] : document.members) {
    if (value.kind == Document::Kind::kText) requirePinholeLens(key, value.text, name);
    requirePinholeLens(value, name);
  }
  for (const Document& item : document.items) requirePinholeLens(item, name);
}

}  // namespace softscope
