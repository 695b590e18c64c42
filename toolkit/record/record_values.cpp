#include "toolkit/record/record_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace softscope {
namespace {

using Json = FactSheet::Json;

/// Value at "a.b.c"; null if absent.
const Json* memberAt(const Json& record, const std::string& path) {
  const Json* at = &record;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    if (!at->is_object()) return nullptr;
    const auto found = at->find(path.substr(begin, end - begin));
    if (found == at->end()) return nullptr;
    at = &*found;
    begin = end + 1;
  }
  return at;
}

}  // namespace

double numberAt(const Json& record, const std::string& path) {
  const Json* found = memberAt(record, path);
  return found != nullptr && found->is_number() ? found->get<double>() : std::nan("");
}

std::string textAt(const Json& record, const std::string& path) {
  const Json* found = memberAt(record, path);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace softscope
