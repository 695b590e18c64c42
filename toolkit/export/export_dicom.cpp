// toolkit/export/export_dicom.cpp: pdf2dcm and img2dcm, started without a shell.
#include "toolkit/export/export_dicom.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/file_bytes.h"
#include "io/images/image_reader.h"
#include "io/text/message.h"
#include "toolkit/record/child_process.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestText = 64;  // characters of PN (a group), LO and of a title we allow

std::string endingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

bool isPdf(const fs::path& file) { return endingOf(file) == ".pdf"; }

/// A folder that is gone with its scope.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string form = (fs::temp_directory_path() / "softscope_dicom_XXXXXX").string();
    if (mkdtemp(form.data()) == nullptr)
      throw Error(shown(fs::temp_directory_path()) + ": no folder can be made there");
    folder_ = form;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  fs::path operator/(const char* name) const { return folder_ / name; }

 private:
  fs::path folder_;
};

/// Along PATH. Throws BackendError.
fs::path findTool(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    struct stat facts {};
    if (!folder.empty() && stat(file.c_str(), &facts) == 0 && S_ISREG(facts.st_mode) &&
        access(file.c_str(), X_OK) == 0)
      return fs::absolute(file);
  }
  throw BackendError(name + " isn't there, which makes DICOM files; install the package dcmtk (" +
                     "Debian: apt install dcmtk)");
}

void appendNumber(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// Windows bitmap, 24 bits: the one form without loss that img2dcm reads.
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
  appendNumber(out, 24, 2);  // bits a pixel
  appendNumber(out, 0, 4);   // not compressed
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

/// NAME=value words; nothing of them is ever read by a shell.
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

std::string firstComplaint(const fs::path& log) {
  std::error_code ignored;
  if (fs::file_size(log, ignored) == 0 || ignored) return "it doesn't say why";
  const std::string text = readBytes(log, kTextLimitBytes);
  const auto at = std::min(text.find("E: "), text.find("F: "));
  const std::string rest = text.substr(at == text.npos ? 0 : at + 3);
  return excerpt(rest.substr(0, rest.find('\n')));
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

bool canBecomeDicom(const fs::path& file) {
  const std::string ending = endingOf(file);
  for (const char* known : {".pdf", ".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"})
    if (ending == known) return true;
  return false;
}

void writeDicom(const fs::path& input, const fs::path& out, const DicomTexts& texts, bool overwrite,
                const std::function<bool()>& interrupted) {
  texts.validate();
  requireWritable(out, overwrite);
  requireFile(input);
  const bool pdf = isPdf(input);
  const std::string tool = pdf ? "pdf2dcm" : "img2dcm";
  std::vector<std::string> words{findTool(tool).string()};
  const TemporaryFolder folder;
  fs::path source = fs::absolute(input);
  if (!pdf) {
    source = folder / "picture.bmp";
    writeFile(source, bmpBytes(readColourImage(input)), true);
    words.insert(words.end(), {"-i", "BMP", "-k", "ConversionType=WSD", "-k", "Modality=OT"});
  }
  for (std::string& word : keysOf(texts, pdf ? "DocumentTitle" : "SeriesDescription"))
    words.push_back(std::move(word));
  const fs::path made = folder / "made.dcm", log = folder / "log.txt";
  words.push_back(source.string());
  words.push_back(made.string());
  const int code = runToEnd(ChildProcess(words, log), interrupted);
  if (code != 0 || !fs::exists(made))
    throw InputError(shown(input) + ": " + tool + " refuses it: " + firstComplaint(log));
  writeFile(out, readBytes(made, std::uintmax_t{2} << 30), overwrite);
}

}  // namespace softscope
