// toolkit/study/study_folder.h: paths within the folder of a study.
#pragma once

#include <filesystem>
#include <string>

namespace softscope {

/// DIR/study.json, table.*, report.html, plots/; DIR/cases/NAME/case.json, log.txt,
/// run/, evaluation/; DIR/sequences/HASH for simulated sequences, shared by cases.
struct StudyFolder {
  std::filesystem::path root;

  std::filesystem::path ofCase(const std::string& name) const { return root / "cases" / name; }
  std::filesystem::path record(const std::string& name) const { return ofCase(name) / "case.json"; }
  std::filesystem::path sequences() const { return root / "sequences"; }
  std::filesystem::path study() const { return root / "study.json"; }

  std::filesystem::path marker() const { return root / "cases" / ".softscope_study"; }

  /// Throws OptionError for a file, or a folder with files of another origin.
  void requireUsable() const;
  /// Marks the folder as that of a study, so that later calls may replace its files.
  void claim() const;
};

}  // namespace softscope
