// toolkit/record/setting_json.h: settings in records.
#pragma once

#include "io/settings/settings_binder.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// JSON value of the text of a setting.
FactSheet::Json valueOf(const SettingInfo& setting);

}  // namespace softscope
