// toolkit/export/structured_report.h: numbers of a report as a DICOM measurement report.
#pragma once

#include <string>

#include "toolkit/export/export_dicom.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct StructuredReport {
  std::string xml;  // input of xml2dsr of dcmtk
  int numbers = 0;
};

/// TID 1500 (DICOM PS3.16): one measurement group (TID 1501) per case, and one for
/// the cohort if there are several. It contains every measured number of the record
/// with its unit (UCUM) and a code: its path in the record, in the private scheme
/// 99SOFTSCOPE; mean, SD, median, minimum and maximum also have the modifier
/// "Derivation" of the standard. Values per frame and histogram bins are omitted.
StructuredReport structuredReport(const FactSheet::Json& metrics, const DicomTexts& texts);

}  // namespace softscope
