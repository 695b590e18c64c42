// toolkit/record/setting_json.cpp: numbers as JSON numbers, texts as JSON strings.
#include "toolkit/record/setting_json.h"

namespace softscope {

FactSheet::Json valueOf(const SettingInfo& setting) {
  if (setting.type == "text") return setting.current_text;
  const auto value =
      FactSheet::Json::parse(setting.current_text, nullptr, /*allow_exceptions=*/false);
  return value.is_discarded() ? FactSheet::Json(setting.current_text) : value;
}

}  // namespace softscope
