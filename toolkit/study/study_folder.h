// toolkit/study/study_folder.h: paths within the folder of a study.
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

  std::filesystem::path marker() const { return root / "cases" / ".softscope_study"; }

  /// Throws OptionError where it is a file, or holds something that no study wrote.
  void requireUsable() const;
  /// Makes it a study's, so that later calls may replace what lies in it.
  void claim() const;
};

}  // namespace softscope
