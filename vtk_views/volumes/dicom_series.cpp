#include "vtk_views/volumes/dicom_series.h"

#include <vtkDICOMDirectory.h>
#include <vtkDICOMMetaData.h>
#include <vtkDICOMParser.h>
#include <vtkDICOMReader.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "core/error.h"
#include "core/guarded_read.h"
#include "vtk_views/files/vtk_errors.h"
#include "vtk_views/volumes/dicom_slices.h"
#include "vtk_views/volumes/packed_volume.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
constexpr int kDeepestFolder = 4;  // nested exports: patient, study, series
constexpr std::size_t kPreambleBytes = 132;
constexpr int kFilesToTry = 50;  // limit of files checked for DICOM

bool hasPreamble(const fs::path& path) {
  char head[kPreambleBytes] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(head, sizeof head) && std::memcmp(head + 128, "DICM", 4) == 0;
}

std::string text(vtkDICOMMetaData* meta, vtkDICOMTag tag) {
  return meta->Has(tag) ? meta->Get(tag).AsUTF8String() : std::string();
}

void add(std::vector<std::pair<std::string, std::string>>& list, const char* name,
         const std::string& value) {
  if (!value.empty()) list.emplace_back(name, value);
}

/// Regular files of the folder and its subfolders; pipes are not opened.
std::vector<std::string> filesIn(const std::string& path) {
  std::vector<std::string> files;
  std::error_code ignored;
  const auto links = fs::directory_options::follow_directory_symlink;
  fs::recursive_directory_iterator entry(path, links, ignored), end;
  for (; entry != end; entry.increment(ignored)) {
    if (entry.depth() >= kDeepestFolder) entry.disable_recursion_pending();
    const std::string name = entry->path().filename().string();
    if (name.empty() || name[0] == '.' || name == "DICOMDIR") continue;
    if (entry->is_regular_file(ignored)) files.push_back(entry->path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Whether the file ends before its pixels do. Not known of compressed and deflated ones.
bool isCutShort(const std::string& file, vtkDICOMParser& parser) {
  constexpr unsigned int kCompressed = 0xffffffff;
  const std::string deflated = "1.2.840.10008.1.2.1.99";
  if (!parser.GetPixelDataFound() || parser.GetPixelDataVL() == kCompressed ||
      text(parser.GetMetaData(), DC::TransferSyntaxUID) == deflated)
    return false;
  const auto end = static_cast<std::uintmax_t>(parser.GetFileOffset()) + parser.GetPixelDataVL();
  return end > fs::file_size(file);
}

/// Tags of one file without pixels; `fault`, if given, of its pixels. Throws InputError.
vtkNew<vtkDICOMMetaData> tagsOf(const std::string& file, std::string* fault = nullptr) {
  vtkNew<vtkDICOMMetaData> meta;
  vtkNew<vtkDICOMParser> parser;
  parser->SetMetaData(meta);
  parser->SetFileName(file.c_str());
  parser->Update();
  if (parser->GetErrorCode() != 0 || meta->GetNumberOfDataElements() == 0)
    throw InputError(file + ": is damaged: its DICOM tags can't be read. Copy it again");
  if (fault != nullptr && isCutShort(file, *parser))
    *fault = file + ": is cut short: it ends before its pixels do. Copy it again";
  return meta;
}

/// Storage classes without images: reports, presentation states, radiotherapy plans, raw data,
/// encapsulated documents, waveforms, directories (DICOM PS3.4, B.5).
bool isDocument(const std::string& storage_class) {
  const std::string storage = "1.2.840.10008.5.1.4.1.1.";
  for (const std::string& start :
       {storage + "88.", storage + "11.", storage + "481.", storage + "66", storage + "104.",
        storage + "9.", std::string("1.2.840.10008.1.3.10")})
    if (storage_class.compare(0, start.size(), start) == 0) return true;
  return false;
}

/// Fault of a file outside of all series; empty for a document.
std::string faultOfStray(const std::string& file) {
  try {
    const vtkNew<vtkDICOMMetaData> meta = tagsOf(file);
    if (!meta->Has(DC::Rows) && isDocument(text(meta, DC::SOPClassUID))) return {};
  } catch (const InputError& error) {
    return error.what();
  }
  return file + ": belongs to no series with images; is it cut short? Copy it again";
}

/// Files outside of all series: a document, or a damaged or truncated
/// slice, which counts as a faulty slice. A file without the DICOM
/// preamble counts as a slice if it has the same file extension.
void addStrays(const std::vector<std::string>& files, const std::vector<std::string>& series,
               const std::set<std::string>& in_series, std::vector<DicomSlice>& slices,
               std::vector<std::string>& warnings) {
  const fs::path ending = fs::path(series.front()).extension();
  for (const std::string& file : files) {
    if (in_series.count(file) > 0) continue;
    DicomSlice stray;
    stray.file = file;
    if (hasPreamble(file))
      stray.fault = faultOfStray(file);
    else if (!ending.empty() && fs::path(file).extension() == ending)
      stray.fault = file + ": is no DICOM file, but named like one; is it cut short? Copy it again";
    else if (fs::file_size(file) < kPreambleBytes)
      warnings.push_back(file + ": is too short for DICOM; a slice that was cut short?");
    if (!stray.fault.empty()) slices.push_back(stray);
  }
}

/// Files of the series with most slices; `warnings` name the others.
std::vector<std::string> largestSeries(const std::string& path,
                                       const std::vector<std::string>& files, bool with_patient,
                                       std::set<std::string>& in_series,
                                       std::vector<std::string>& warnings) {
  vtkNew<vtkStringArray> names;
  for (const std::string& file : files) names->InsertNextValue(file);
  vtkNew<vtkDICOMDirectory> directory;
  directory->SetInputFileNames(names);
  directory->IgnoreDicomdirOn();
  updateOrThrow(*directory, path);
  const int count = directory->GetNumberOfSeries();
  if (count == 0) throw InputError(path + ": no DICOM series with images in this folder");
  std::vector<std::vector<std::string>> series;
  for (int i = 0; i < count; ++i) {
    vtkStringArray* of_series = directory->GetFileNamesForSeries(i);
    series.emplace_back();
    for (vtkIdType k = 0; k < of_series->GetNumberOfValues(); ++k)
      series.back().push_back(of_series->GetValue(k));
    in_series.insert(series.back().begin(), series.back().end());
  }
  const auto largest =
      std::max_element(series.begin(), series.end(),
                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
  for (auto other = series.begin(); other != series.end(); ++other)
    if (other != largest)
      warnings.push_back(
          "the folder contains another series, of " + std::to_string(other->size()) + " files" +
          (with_patient ? ": " + text(directory->GetMetaDataForSeries(int(other - series.begin())),
                                      DC::SeriesDescription)
                        : ""));
  return *largest;
}

void describe(vtkDICOMMetaData* meta, VolumeSummary& summary) {
  add(summary.details, "modality", text(meta, DC::Modality));
  add(summary.details, "body_part", text(meta, DC::BodyPartExamined));
  add(summary.details, "slice_thickness_mm", text(meta, DC::SliceThickness));
  add(summary.details, "manufacturer", text(meta, DC::Manufacturer));
}

void describePatient(vtkDICOMMetaData* meta, VolumeSummary& summary) {
  add(summary.patient, "name", text(meta, DC::PatientName));
  add(summary.patient, "id", text(meta, DC::PatientID));
  add(summary.patient, "sex", text(meta, DC::PatientSex));
  add(summary.patient, "birth_date", text(meta, DC::PatientBirthDate));
  add(summary.patient, "study_date", text(meta, DC::StudyDate));
  add(summary.patient, "series", text(meta, DC::SeriesDescription));  // free text: may name anyone
}

VoxelType voxelTypeOf(const std::string& path, int vtk_type) {
  switch (vtk_type) {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return VoxelType::kInt8;
    case VTK_UNSIGNED_CHAR:
      return VoxelType::kUint8;
    case VTK_SHORT:
      return VoxelType::kInt16;
    case VTK_UNSIGNED_SHORT:
      return VoxelType::kUint16;
    case VTK_INT:
      return VoxelType::kInt32;
    case VTK_UNSIGNED_INT:
      return VoxelType::kUint32;
    case VTK_FLOAT:
      return VoxelType::kFloat32;
    case VTK_DOUBLE:
      return VoxelType::kFloat64;
    default:
      throw InputError(path + ": its voxels are of a type that softscope doesn't read");
  }
}

/// Pixels of all frames of these files, in this order.
void readPixels(const std::string& path, const DicomStack& stack, StoredVolume& volume) {
  vtkNew<vtkStringArray> names;
  for (const std::string& file : stack.files) names->InsertNextValue(file);
  vtkNew<vtkDICOMReader> reader;
  reader->SetMemoryRowOrderToFileNative();  // voxel (0, 0, 0) is the first pixel in the file
  reader->SortingOff();                     // sorted by us
  reader->SetFileNames(names);
  updateOrThrow(*reader, path);
  vtkImageData& image = *reader->GetOutput();
  const int* size = image.GetDimensions();
  int frame = 0;
  for (vtkIdType i = 0; i < reader->GetFileIndexArray()->GetNumberOfTuples(); ++i, ++frame)
    if (i > 0 && reader->GetFileIndexArray()->GetComponent(i, 0) <
                     reader->GetFileIndexArray()->GetComponent(i - 1, 0))
      throw Error(path + ": vtk-dicom changed the order of its files");
  const int last = *std::max_element(stack.stored_slices.begin(), stack.stored_slices.end());
  if (frame != size[2] || last >= size[2] || image.GetScalarPointer() == nullptr)
    throw InputError(path + ": holds " + std::to_string(size[2]) +
                     " slices that can be read, but " + std::to_string(last + 1) +
                     " are announced. Copy it again");
  VolumeSummary& summary = volume.summary;
  summary.size_voxels = {size[0], size[1], static_cast<int>(stack.stored_slices.size())};
  summary.components = image.GetNumberOfScalarComponents();
  volume.type = voxelTypeOf(path, image.GetScalarType());
  volume.stored_slices = stack.stored_slices;
  const std::size_t count = std::size_t(image.GetNumberOfPoints()) *
                            std::size_t(summary.components) * bytesOf(volume.type);
  volume.bytes.assign(static_cast<const char*>(image.GetScalarPointer()), count);
}

StoredVolume readSeries(const std::string& path, const std::vector<std::string>& files,
                        const VolumeOptions& options) {
  StoredVolume volume;
  volume.summary.format = "DICOM";
  volume.summary.file_space = "LPS";
  std::set<std::string> in_series;
  std::vector<std::string> series = files;
  if (fs::is_directory(path))
    series = largestSeries(path, files, options.with_patient, in_series, volume.summary.warnings);
  std::vector<DicomSlice> slices;
  if (fs::is_directory(path)) addStrays(files, series, in_series, slices, volume.summary.warnings);
  bool rescaled = true;
  for (const std::string& file : series) {
    std::string fault;
    const vtkNew<vtkDICOMMetaData> meta = tagsOf(file, &fault);
    std::vector<DicomSlice> of_file = slicesOf(file, *meta, options);
    for (DicomSlice& slice : of_file)
      if (slice.fault.empty()) slice.fault = fault;
    slices.insert(slices.end(), of_file.begin(), of_file.end());
    rescaled = rescaled && meta->Get(0, 0, DC::RescaleIntercept).IsValid();
    if (file != series.front()) continue;
    describe(meta, volume.summary);
    if (options.with_patient) describePatient(meta, volume.summary);
  }
  const DicomStack stack = stackOf(path, std::move(slices), options);
  for (const std::string& warning : stack.warnings) volume.summary.warnings.push_back(warning);
  readPixels(path, stack, volume);
  placeVolume(stack.lps_from_voxel, stack.spacing_said, options, volume.summary);
  if (!rescaled)
    for (const auto& [name, value] : volume.summary.details)
      if (name == "modality" && value == "CT")
        volume.summary.warnings.emplace_back(
            "RescaleIntercept is missing: values may not be Hounsfield units");
  return volume;
}

}  // namespace

bool looksLikeDicom(const std::string& path) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return hasPreamble(path);
  int tried = 0;
  fs::recursive_directory_iterator entry(path, ignored), end;
  for (; entry != end && tried < kFilesToTry; entry.increment(ignored)) {
    if (entry.depth() >= kDeepestFolder) entry.disable_recursion_pending();
    if (!entry->is_regular_file(ignored)) continue;
    if (hasPreamble(entry->path())) return true;
    ++tried;
  }
  return false;
}

StoredVolume loadDicom(const std::string& path, const VolumeOptions& options) {
  std::vector<std::string> files{path};
  if (fs::is_directory(path)) files = filesIn(path);
  std::uintmax_t bytes = 0;
  for (const std::string& file : files) {
    requireRegularFile(file);
    bytes += fs::file_size(file);
  }
  return unpackVolume(
      guardedRead(path, bytes, [&] { return packVolume(readSeries(path, files, options)); }));
}

}  // namespace softscope
