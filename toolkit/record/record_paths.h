// toolkit/record/record_paths.h: names instead of paths in the JSON of all commands.
#pragma once

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Whether a record keeps full paths (--keep-paths).
struct RecordPaths {
  bool keep = false;

  /// Record as written and printed: each path becomes the name of its file or folder, in
  /// the inputs, in stereo.model and within texts. Other settings, machine and style are
  /// kept. With --keep-paths the record is unchanged. No command reads paths from a record.
  FactSheet::Json applyTo(const FactSheet::Json& record) const;
};

}  // namespace softscope
