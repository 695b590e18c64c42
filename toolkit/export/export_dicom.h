// toolkit/export/export_dicom.h: reports, images and models as DICOM, by dcmtk's tools.
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

/// What a file becomes, by its ending.
enum class DicomKind { kDocument, kPicture, kMeasurements, kModel };
DicomKind dicomKindOf(const std::filesystem::path& file);

/// Where a DICOM file goes. Every file is a study of its own. The patient's name and ID stay empty
/// unless given. `interrupted` stops dcmtk's tool.
struct DicomTarget {
  std::filesystem::path out;
  DicomTexts texts;
  bool overwrite = false;
  std::function<bool()> interrupted;
};

/// Each throws BackendError where dcmtk isn't installed, InputError for a file that it refuses.
/// A PDF becomes an Encapsulated PDF.
void writeDicomDocument(const std::filesystem::path& pdf, const DicomTarget& target);
/// An image becomes a Secondary Capture.
void writeDicomPicture(const std::filesystem::path& picture, const DicomTarget& target);
/// The numbers of a report (.html of `softscope report`) become a Structured Report, TID 1500
/// (toolkit/export/structured_report.h). Returns how many.
int writeDicomMeasurements(const std::filesystem::path& report, const DicomTarget& target);
/// A surface becomes an Encapsulated STL in mm. `stl`: a binary STL; `name`: of its file in errors.
void writeDicomModel(const std::string& stl, const std::filesystem::path& name,
                     const DicomTarget& target);

}  // namespace softscope
