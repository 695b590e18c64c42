// apps/study_folder.h: where a study keeps what.
#pragma once

#include <filesystem>
#include <string>

namespace softscope {

/// DIR/study.json, table.*, report.html, plots/; DIR/cases/NAME/case.json, log.txt, run/,
/// evaluation/; DIR/sequences/HASH of what was simulated, shared by cases.
struct StudyFolder {
  std::filesystem::path root;

  std::filesystem::path ofCase(const std::string& name) const { return root / "cases" / name; }
  std::filesystem::path record(const std::string& name) const { return ofCase(name) / "case.json"; }
  std::filesystem::path sequences() const { return root / "sequences"; }
  std::filesystem::path study() const { return root / "study.json"; }

  /// Throws OptionError where it is a file, or holds something that is no study.
  void requireUsable() const;
};

}  // namespace softscope
