// toolkit/export/export_dicom.cpp: arguments of the tools of dcmtk for each kind of file.
#include "toolkit/export/export_dicom.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <vector>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/images/image_reader.h"
#include "io/text/message.h"
#include "toolkit/export/dicom_tools.h"
#include "toolkit/export/structured_report.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestText = 64;  // characters of PN (a group) and LO; limit of a title

std::string endingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

void appendNumber(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// Windows bitmap, 24 bits: the only lossless format that img2dcm reads.
std::string bmpBytes(const ColourImage& image) {
  constexpr std::uint32_t kHeadersBytes = 54, kInfoBytes = 40;
  const auto row_bytes = std::uint32_t((3 * image.width_px + 3) / 4 * 4);
  const std::uint32_t data_bytes = row_bytes * std::uint32_t(image.height_px);
  std::string out = "BM";
  appendNumber(out, kHeadersBytes + data_bytes, 4);
  appendNumber(out, 0, 4);
  for (const std::uint32_t value :
       {kHeadersBytes, kInfoBytes, std::uint32_t(image.width_px), std::uint32_t(image.height_px)})
    appendNumber(out, value, 4);
  appendNumber(out, 1, 2);   // plane
  appendNumber(out, 24, 2);  // bits per pixel
  appendNumber(out, 0, 4);   // no compression
  appendNumber(out, data_bytes, 4);
  out.append(16, '\0');  // resolution and palette: none
  for (int v = image.height_px - 1; v >= 0; --v) {
    const std::size_t row = out.size();
    for (int u = 0; u < image.width_px; ++u) {
      const Rgb8& pixel = image.at(u, v);
      for (const std::uint8_t channel : {pixel.blue, pixel.green, pixel.red})
        out += static_cast<char>(channel);
    }
    out.resize(row + row_bytes, '\0');
  }
  return out;
}

/// Arguments NAME=value.
std::vector<std::string> keysOf(const DicomTexts& texts, const std::string& title_name) {
  std::vector<std::string> words;
  const auto add = [&](const std::string& name, const std::string& value) {
    words.push_back("-k");
    words.push_back(name + "=" + value);
  };
  add("SpecificCharacterSet", "ISO_IR 192");  // UTF-8
  add("PatientName", texts.patient_name);
  add("PatientID", texts.patient_id);
  add("Manufacturer", "softscope");
  if (!texts.title.empty()) add(title_name, texts.title);
  return words;
}

void writeMade(const std::string& tool, std::vector<std::string> words, const fs::path& source,
               const fs::path& name, const DicomTarget& target) {
  target.texts.validate();
  requireWritable(target.out, target.overwrite);
  writeFile(target.out, dicomBytes(tool, std::move(words), source, name, target.interrupted),
            target.overwrite);
}

/// JSON embedded in a report. Throws InputError.
FactSheet::Json metricsOfReport(const fs::path& report) {
  const std::string begin = "<script type=\"application/json\" id=\"metrics\">";
  const std::string html = readBytes(report);
  const auto at = html.find(begin);
  const auto end = at == html.npos ? at : html.find("</script>", at);
  if (end == html.npos)
    throw InputError(shown(report) +
                     ": is not a report with metrics; a DICOM report needs the page written by "
                     "`softscope report`");
  FactSheet::Json json = FactSheet::Json::parse(
      html.substr(at + begin.size(), end - at - begin.size()), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("cases") || !json["cases"].is_array())
    throw InputError(shown(report) + ": its metrics are damaged; write the report again");
  return json;
}

void requireText(const std::string& text, const char* option) {
  const bool plain = std::none_of(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == '\\' || c == 0x7F; });
  if (plain && text.size() <= kLongestText) return;
  throw OptionError(std::string(option) + " must be one line of at most " +
                    std::to_string(kLongestText) + " bytes without backslashes");
}

}  // namespace

void DicomTexts::validate() const {
  requireText(patient_name, "`patient_name=`");
  requireText(patient_id, "`patient_id=`");
  requireText(title, "`title=`");
}

DicomKind dicomKindOf(const fs::path& file) {
  const std::string ending = endingOf(file);
  if (ending == ".pdf") return DicomKind::kDocument;
  if (ending == ".html" || ending == ".htm") return DicomKind::kMeasurements;
  for (const char* known : {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"})
    if (ending == known) return DicomKind::kPicture;
  return DicomKind::kModel;
}

void writeDicomDocument(const fs::path& pdf, const DicomTarget& target) {
  requireFile(pdf);
  writeMade("pdf2dcm", keysOf(target.texts, "DocumentTitle"), fs::absolute(pdf), pdf, target);
}

void writeDicomPicture(const fs::path& picture, const DicomTarget& target) {
  requireFile(picture);
  const TemporaryFolder folder;
  const fs::path source = folder / "picture.bmp";
  writeFile(source, bmpBytes(readColourImage(picture)), true);
  // Laterality of an unpaired body part is empty, not absent.
  std::vector<std::string> words{"-i", "BMP",         "-k", "ConversionType=WSD",
                                 "-k", "Modality=OT", "-k", "Laterality="};
  for (std::string& word : keysOf(target.texts, "SeriesDescription"))
    words.push_back(std::move(word));
  writeMade("img2dcm", std::move(words), source, picture, target);
}

int writeDicomMeasurements(const fs::path& report, const DicomTarget& target) {
  target.texts.validate();
  const StructuredReport made = structuredReport(metricsOfReport(report), target.texts);
  const TemporaryFolder folder;
  const fs::path source = folder / "report.xml";
  writeFile(source, made.xml, true);
  // Replaces the placeholder UIDs of the XML.
  writeMade("xml2dsr", {"--generate-new-uids", "--overwrite-uids"}, source, report, target);
  return made.numbers;
}

void writeDicomModel(const std::string& stl, const fs::path& name, const DicomTarget& target) {
  const TemporaryFolder folder;
  const fs::path source = folder / "model.stl";
  writeFile(source, stl, true);
  std::vector<std::string> words{"--manufacturer-model", "softscope",  "--device-serial", "none",
                                 "--software-versions",  versionText()};
  words.insert(words.end(), {"--measurement-units", "UCUM", "mm", "mm"});  // the default is um
  for (std::string& word : keysOf(target.texts, "DocumentTitle")) words.push_back(std::move(word));
  writeMade("stl2dcm", std::move(words), source, name, target);
}

}  // namespace softscope
