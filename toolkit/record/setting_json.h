// toolkit/record/setting_json.h: settings as records keep them.
#pragma once

#include "io/settings/settings_binder.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// A setting's text as the JSON value that it stands for.
FactSheet::Json valueOf(const SettingInfo& setting);

}  // namespace softscope
