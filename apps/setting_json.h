// apps/setting_json.h: settings as records keep them.
#pragma once

#include "apps/fact_sheet.h"
#include "io/settings_binder.h"

namespace softscope {

/// A setting's text as the JSON value that it stands for.
FactSheet::Json valueOf(const SettingInfo& setting);

}  // namespace softscope
