// toolkit/record/record_paths.h: names in the place of paths in the JSON that commands write.
#pragma once

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Whether a record keeps whole paths (--keep-paths).
struct RecordPaths {
  bool keep = false;

  /// The record as it is written and printed: each path becomes the name of its file or folder, in
  /// the inputs, in stereo.model and within texts. Other settings, machine and style stay. With
  /// --keep-paths the record itself. No command reads a path back from a record.
  FactSheet::Json applyTo(const FactSheet::Json& record) const;
};

}  // namespace softscope
