// toolkit/export/structured_report.h: the numbers of a report as a DICOM measurement report.
#pragma once

#include <string>

#include "toolkit/export/export_dicom.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct StructuredReport {
  std::string xml;  // as dcmtk's xml2dsr reads it
  int numbers = 0;
};

/// TID 1500 (DICOM PS3.16): a measurement group (TID 1501) per case, and one of the cohort where
/// there are several. In it every number of the record that was measured, with its unit (UCUM) and
/// a code: the path of the number in the record, of the private scheme 99SOFTSCOPE; mean, SD,
/// median, minimum and maximum also have the standard's modifier "Derivation". Values per frame and
/// bins of histograms stay out.
StructuredReport structuredReport(const FactSheet::Json& metrics, const DicomTexts& texts);

}  // namespace softscope
