// toolkit/export/export_dicom.h: reports, images and models as DICOM, by the tools of dcmtk.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace softscope {

/// Texts about patient and document; empty: omitted.
struct DicomTexts {
  std::string patient_name, patient_id, title;

  /// Throws OptionError for characters that a DICOM text cannot contain, or for too long a text.
  void validate() const;
};

/// Kind of DICOM file, by the file extension of the input.
enum class DicomKind { kDocument, kPicture, kMeasurements, kModel };
DicomKind dicomKindOf(const std::filesystem::path& file);

/// Output of a DICOM file. Every file is its own study. Name and ID of the
/// patient are empty by default. `interrupted` stops the tool of dcmtk.
struct DicomTarget {
  std::filesystem::path out;
  DicomTexts texts;
  bool overwrite = false;
  std::function<bool()> interrupted;
};

/// Throws BackendError if dcmtk is not installed, InputError
/// for a file that it refuses. PDF to Encapsulated PDF.
void writeDicomDocument(const std::filesystem::path& pdf, const DicomTarget& target);
/// Image to Secondary Capture.
void writeDicomPicture(const std::filesystem::path& picture, const DicomTarget& target);
/// Numbers of a report (.html of `softscope report`) to a Structured Report,
/// TID 1500 (toolkit/export/structured_report.h). Returns their count.
int writeDicomMeasurements(const std::filesystem::path& report, const DicomTarget& target);
/// Surface to Encapsulated STL in mm. `stl`: a binary STL; `name`: file name in errors.
void writeDicomModel(const std::string& stl, const std::filesystem::path& name,
                     const DicomTarget& target);

}  // namespace softscope
