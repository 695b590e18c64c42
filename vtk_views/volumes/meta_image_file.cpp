// vtk_views/volumes/meta_image_file.cpp: reader of MetaImage (.mha, .mhd).
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "vtk_views/volumes/header_text.h"
#include "vtk_views/volumes/volume_formats.h"
#include "vtk_views/volumes/voxel_bytes.h"

namespace softscope {
namespace {

constexpr std::int64_t kMaxVoxelsPerSide = std::int64_t{1} << 30;

/// Keys used by this reader.
const std::vector<std::string> kReadKeys{
    "ObjectType",      "NDims",       "BinaryData",    "BinaryDataByteOrderMSB",
    "CompressedData",  "DimSize",     "HeaderSize",    "ElementByteOrderMSB",
    "TransformMatrix", "Rotation",    "Orientation",   "ElementNumberOfChannels",
    "Offset",          "Position",    "Origin",        "ElementSpacing",
    "ElementSize",     "ElementType", "DistanceUnits", "ElementDataFile"};

/// Other keys of the format.
const std::vector<std::string> kHarmlessKeys{"AcquisitionDate",
                                             "AnatomicalOrientation",
                                             "CenterOfRotation",
                                             "Color",
                                             "Comment",
                                             "CompressedDataSize",
                                             "CompressionLevel",
                                             "ElementMax",
                                             "ElementMin",
                                             "ElementNBits",
                                             "ID",
                                             "ElementToIntensityFunctionOffset",
                                             "Kinds",
                                             "ElementToIntensityFunctionSlope",
                                             "Modality",
                                             "Name",
                                             "ObjectSubType",
                                             "ParentID",
                                             "SequenceID",
                                             "TransformType"};

/// Keys added by ITK and Slicer: DICOM tags ("0008|0060") and private fields.
bool isNoteOfAProgram(const std::string& key) {
  const bool is_tag = key.size() == 9 && key[4] == '|';
  return is_tag || key.compare(0, 4, "ITK_") == 0 || key.compare(0, 4, "Seq_") == 0;
}

void warnOfUnknownKeys(const HeaderText& header, VolumeSummary& summary) {
  std::string names;
  for (const std::string& key : header.unknownKeys(kReadKeys, kHarmlessKeys))
    if (!isNoteOfAProgram(key)) names += (names.empty() ? "" : ", ") + key;
  if (!names.empty())
    summary.warnings.emplace_back("the header has lines unknown to softscope: " + names);
}

VoxelType metaImageType(const HeaderText& header) {
  static const std::pair<const char*, VoxelType> kTypes[] = {
      {"MET_CHAR", VoxelType::kInt8},       {"MET_UCHAR", VoxelType::kUint8},
      {"MET_SHORT", VoxelType::kInt16},     {"MET_USHORT", VoxelType::kUint16},
      {"MET_INT", VoxelType::kInt32},       {"MET_UINT", VoxelType::kUint32},
      {"MET_LONG", VoxelType::kInt32},      {"MET_ULONG", VoxelType::kUint32},
      {"MET_LONG_LONG", VoxelType::kInt64}, {"MET_ULONG_LONG", VoxelType::kUint64},
      {"MET_FLOAT", VoxelType::kFloat32},   {"MET_DOUBLE", VoxelType::kFloat64}};
  const std::string& name = header.text("ElementType");
  for (const auto& [known, type] : kTypes)
    if (name == known || name == std::string(known) + "_ARRAY") return type;
  header.fail("ElementType", "but must be one of MET_CHAR, MET_UCHAR … MET_DOUBLE");
}

double metaImageUnitMm(const HeaderText& header) {
  const std::string unit = header.textOr("DistanceUnits", "mm");
  if (unit == "mm" || unit == "?") return 1;
  if (unit == "um") return 0.001;
  if (unit == "cm") return 10;
  header.fail("DistanceUnits", "but must be um, mm or cm");
}

/// Voxel spacing in mm, or ones if given by the user.
std::vector<double> metaImageSpacing(const HeaderText& header, const VolumeOptions& options) {
  const std::string key = header.firstOf({"ElementSpacing", "ElementSize"});
  if (key.empty() && options.spacing_mm) return {1, 1, 1};
  if (key.empty())
    throw InputError(header.path() +
                     ": the header has no line `ElementSpacing`, so the size of a "
                     "voxel is unknown; " +
                     kStateSpacing);
  if (options.spacing_mm && finiteNumbers(header.text(key)).size() != 3) return {1, 1, 1};
  std::vector<double> spacing = finiteNumbers(header.text(key));
  if (spacing.size() != 3)
    header.fail(key, std::string("but must be three lengths above 0; ") + kStateSpacing);
  for (double& length : spacing) {
    if (!(length > 0) && !options.spacing_mm)
      header.fail(key, std::string("but a voxel's sides are longer than 0; ") + kStateSpacing);
    length = length > 0 ? length * metaImageUnitMm(header) : 1;
  }
  return spacing;
}

/// Unit vectors, nearly orthogonal, as ITK writes and requires.
void checkDirections(const HeaderText& header, const std::string& key,
                     const Eigen::Matrix3d& directions) {
  constexpr double kTolerance = 0.01;  // of a length or cosine: half a degree
  const Eigen::Matrix3d product = directions.transpose() * directions;
  if (!(product - Eigen::Matrix3d::Identity()).isZero(kTolerance))
    header.fail(
        key, "but must hold three directions of length 1 at right angles. Is the header damaged?");
}

Eigen::Matrix4d metaImagePlace(const HeaderText& header, const VolumeOptions& options,
                               VolumeSummary& summary) {
  Eigen::Matrix4d lps_from_voxel = Eigen::Matrix4d::Identity();
  const std::string turn = header.firstOf({"TransformMatrix", "Rotation", "Orientation"});
  const std::string offset = header.firstOf({"Offset", "Position", "Origin"});
  summary.file_space = "LPS";
  if (turn.empty())
    summary.warnings.emplace_back(
        "the header has no TransformMatrix: axes taken to run to left, back and head, which is the "
        "format's default");
  else
    lps_from_voxel.topLeftCorner<3, 3>() =
        Eigen::Map<const Eigen::Matrix3d>(header.numbers(turn, 9).data());
  if (!turn.empty()) checkDirections(header, turn, lps_from_voxel.topLeftCorner<3, 3>());
  if (offset.empty())
    summary.warnings.emplace_back("the header has no Offset: the first voxel was put at 0, 0, 0");
  else
    lps_from_voxel.topRightCorner<3, 1>() =
        metaImageUnitMm(header) *
        Eigen::Map<const Eigen::Vector3d>(header.numbers(offset, 3).data());
  const std::vector<double> spacing = metaImageSpacing(header, options);
  for (int axis = 0; axis < 3; ++axis) lps_from_voxel.col(axis) *= spacing[std::size_t(axis)];
  checkAxes(header.path(), "ElementSpacing and Offset", lps_from_voxel);
  return lps_from_voxel;
}

std::string metaImageVoxels(const HeaderText& header, VoxelBlock block) {
  const std::string& data = header.text("ElementDataFile");
  const bool local = data == "LOCAL" || data == "Local" || data == "local";
  if (data.empty() || data.compare(0, 4, "LIST") == 0 || data.find('%') != std::string::npos)
    header.fail("ElementDataFile",
                "but softscope reads LOCAL or the name of one file; join the slices to one file");
  block.file = std::filesystem::path(header.path());
  if (!local) block.file = block.file.parent_path() / data;
  block.offset = local ? header.endOffset() : 0;
  if (!header.flagOr("BinaryData", true))
    header.fail("BinaryData", "but softscope reads binary voxels alone; save it as binary");
  block.big_endian = header.flagOr(
      header.has("ElementByteOrderMSB") ? "ElementByteOrderMSB" : "BinaryDataByteOrderMSB", false);
  const bool packed = header.flagOr("CompressedData", false);
  if (header.has("HeaderSize") && !local) {
    const auto skip = header.wholes("HeaderSize", 1, -1, kMaxVoxelsPerSide)[0];
    const double length = block.voxels * block.components * double(bytesOf(block.type));
    std::error_code problem;
    const double size = double(std::filesystem::file_size(block.file, problem));
    if (skip >= 0)
      block.offset = static_cast<std::uintmax_t>(skip);
    else if (!packed && !problem && size > length)
      block.offset = static_cast<std::uintmax_t>(size - length);
  }
  return packed ? readPackedVoxels(block) : readPlainVoxels(block);
}

}  // namespace

StoredVolume readMetaImage(const std::string& path, const VolumeOptions& options) {
  const HeaderText header = HeaderText::readMetaImage(path, "ElementDataFile");
  if (header.textOr("ObjectType", "Image") != "Image")
    header.fail("ObjectType", "but a volume is an Image");
  StoredVolume volume;
  warnOfUnknownKeys(header, volume.summary);
  header.wholes("NDims", 1, 3, 3);
  VoxelBlock block;
  volume.summary.format = "MetaImage";
  block.voxels = 1;
  const auto sizes = header.wholes("DimSize", 3, 1, kMaxVoxelsPerSide);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    volume.summary.size_voxels[axis] = static_cast<int>(sizes[axis]);
    block.voxels *= double(sizes[axis]);
  }
  if (header.has("ElementNumberOfChannels"))
    volume.summary.components =
        static_cast<int>(header.wholes("ElementNumberOfChannels", 1, 1, 1000)[0]);
  block.components = volume.summary.components;
  block.type = volume.type = metaImageType(header);
  const bool said = header.has("ElementSpacing") || header.has("ElementSize");
  placeVolume(metaImagePlace(header, options, volume.summary), said, options, volume.summary);
  volume.bytes = metaImageVoxels(header, block);
  return volume;
}

}  // namespace softscope
