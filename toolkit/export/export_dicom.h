// toolkit/export/export_dicom.h: reports and pictures for a hospital's archive, by way of dcmtk's
// tools.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace softscope {

/// What the DICOM file says of its patient and itself; empty: nothing.
struct DicomTexts {
  std::string patient_name, patient_id, title;

  /// Throws OptionError for characters that a DICOM text can't hold, or more than it takes.
  void validate() const;
};

/// True for a PDF or a picture by its ending: what can become a DICOM file.
bool canBecomeDicom(const std::filesystem::path& file);

/// A PDF becomes an Encapsulated PDF, a picture a Secondary Capture; every file is a study of its
/// own. The patient's name and ID stay empty unless given. Throws BackendError where dcmtk isn't
/// installed, InputError for a file that it refuses. `interrupted` stops dcmtk's tool.
void writeDicom(const std::filesystem::path& input, const std::filesystem::path& out,
                const DicomTexts& texts, bool overwrite, const std::function<bool()>& interrupted);

}  // namespace softscope
