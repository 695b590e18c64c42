// vtk_views/volumes/nifti_file.cpp: reader of NIfTI-1 and NIfTI-2 (.nii, .nii.gz).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "vtk_views/volumes/header_text.h"
#include "vtk_views/volumes/volume_formats.h"
#include "vtk_views/volumes/voxel_bytes.h"

namespace softscope {
namespace {

/// Used fields of either version; names as in the standard.
struct NiftiHeader {
  std::array<double, 8> dim{}, pixdim{};
  int datatype = 0, bitpix = 0, qform_code = 0, sform_code = 0, xyzt_units = 0;
  double vox_offset = 0, scl_slope = 0, scl_inter = 0;
  std::array<double, 3> quatern{}, qoffset{};
  std::array<std::array<double, 4>, 3> srow{};
};

constexpr std::size_t kNifti1Bytes = 348, kNifti2Bytes = 540;

/// Numbers at given offsets of the header, in its byte order.
class NiftiFields {
 public:
  NiftiFields(const std::string& bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  template <class Stored>
  double at(std::size_t offset) const {
    std::array<char, sizeof(Stored)> raw{};
    std::memcpy(raw.data(), bytes_.data() + offset, raw.size());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    Stored value{};
    std::memcpy(&value, raw.data(), raw.size());
    return static_cast<double>(value);
  }
  template <class Stored, std::size_t kCount>
  void fill(std::size_t offset, std::array<double, kCount>& values) const {
    for (std::size_t i = 0; i < kCount; ++i) values[i] = at<Stored>(offset + i * sizeof(Stored));
  }

 private:
  const std::string& bytes_;
  bool swapped_;
};

NiftiHeader nifti1Of(const NiftiFields& fields) {
  NiftiHeader header;
  fields.fill<std::int16_t>(40, header.dim);
  header.datatype = int(fields.at<std::int16_t>(70));
  header.bitpix = int(fields.at<std::int16_t>(72));
  fields.fill<float>(76, header.pixdim);
  header.vox_offset = fields.at<float>(108);
  header.scl_slope = fields.at<float>(112);
  header.scl_inter = fields.at<float>(116);
  header.xyzt_units = int(fields.at<std::uint8_t>(123));
  header.qform_code = int(fields.at<std::int16_t>(252));
  header.sform_code = int(fields.at<std::int16_t>(254));
  fields.fill<float>(256, header.quatern);
  fields.fill<float>(268, header.qoffset);
  for (std::size_t row = 0; row < 3; ++row) fields.fill<float>(280 + 16 * row, header.srow[row]);
  return header;
}

NiftiHeader nifti2Of(const NiftiFields& fields) {
  NiftiHeader header;
  header.datatype = int(fields.at<std::int16_t>(12));
  header.bitpix = int(fields.at<std::int16_t>(14));
  fields.fill<std::int64_t>(16, header.dim);
  fields.fill<double>(104, header.pixdim);
  header.vox_offset = fields.at<std::int64_t>(168);
  header.scl_slope = fields.at<double>(176);
  header.scl_inter = fields.at<double>(184);
  header.qform_code = int(fields.at<std::int32_t>(344));
  header.sform_code = int(fields.at<std::int32_t>(348));
  fields.fill<double>(352, header.quatern);
  fields.fill<double>(376, header.qoffset);
  for (std::size_t row = 0; row < 3; ++row) fields.fill<double>(400 + 32 * row, header.srow[row]);
  header.xyzt_units = int(fields.at<std::int32_t>(500));
  return header;
}

[[noreturn]] void failNifti(const std::string& path, const char* field, double value,
                            const std::string& complaint) {
  std::string number = std::to_string(value);
  number.erase(number.find_last_not_of('0') + 1);
  if (!number.empty() && number.back() == '.') number.pop_back();
  throw InputError(path + ": `" + field + "` is " + number + ", " + complaint);
}

NiftiHeader readNiftiHeader(const std::string& path, bool& big_endian) {
  const std::string bytes = firstBytes(path, kNifti2Bytes);
  if (bytes.size() < kNifti1Bytes)
    throw InputError(path + ": is shorter than NIfTI's header of 348 bytes. Copy it again");
  for (const bool swapped : {false, true}) {
    const NiftiFields fields(bytes, swapped);
    const double size = fields.at<std::int32_t>(0);
    big_endian = swapped;  // the machine is little-endian
    if (size == double(kNifti1Bytes)) {
      if (bytes.compare(344, 4, std::string("n+1\0", 4)) != 0)
        throw InputError(path + ": `magic` is " + inQuotes(bytes.substr(344, 4)) +
                         ", but must be n+1: a NIfTI file with its voxels. Convert it to .nii");
      return nifti1Of(fields);
    }
    if (size != double(kNifti2Bytes) || bytes.size() < kNifti2Bytes) continue;
    if (bytes.compare(4, 8, std::string("n+2\0\r\n\032\n", 8)) != 0)
      throw InputError(path + ": `magic` is " + inQuotes(bytes.substr(4, 8)) +
                       ", but must be n+2. Copy it again; line ends may have been converted");
    return nifti2Of(fields);
  }
  throw InputError(path + ": does not begin with NIfTI's header size, 348 or 540. Is it damaged?");
}

void takeNiftiType(const std::string& path, const NiftiHeader& header, StoredVolume& volume) {
  struct Known {
    int code;
    VoxelType type;
    int components;
  };
  static const Known kTypes[] = {
      {2, VoxelType::kUint8, 1},     {4, VoxelType::kInt16, 1},    {8, VoxelType::kInt32, 1},
      {16, VoxelType::kFloat32, 1},  {64, VoxelType::kFloat64, 1}, {256, VoxelType::kInt8, 1},
      {512, VoxelType::kUint16, 1},  {768, VoxelType::kUint32, 1}, {1024, VoxelType::kInt64, 1},
      {1280, VoxelType::kUint64, 1}, {128, VoxelType::kUint8, 3},  {2304, VoxelType::kUint8, 4}};
  for (const Known& known : kTypes) {
    if (known.code != header.datatype) continue;
    volume.type = known.type;
    volume.summary.components = known.components;
    const int bits = 8 * int(bytesOf(known.type)) * known.components;
    if (header.bitpix != bits)
      failNifti(path, "bitpix", header.bitpix,
                "but datatype " + std::to_string(header.datatype) + " has " + std::to_string(bits) +
                    " bits. Is the header damaged?");
    return;
  }
  failNifti(path, "datatype", header.datatype, "which softscope doesn't read; save it as numbers");
}

/// Sizes along i, j, k; further axes are values of a voxel.
void takeNiftiSizes(const std::string& path, const NiftiHeader& header, StoredVolume& volume) {
  const double axes = header.dim[0];
  if (axes < 3 || axes > 7)
    failNifti(path, "dim[0]", axes, "but a volume has 3 axes, at most 7. Is the header damaged?");
  double more = 1;
  for (std::size_t axis = 1; axis <= std::size_t(axes); ++axis) {
    const double size = header.dim[axis];
    if (!(size >= 1 && size <= (1 << 30)))
      failNifti(path, ("dim[" + std::to_string(axis) + "]").c_str(), size,
                "but must be 1 or more. Is the header damaged?");
    if (axis <= 3)
      volume.summary.size_voxels[axis - 1] = int(size);
    else
      more *= size;
  }
  if (more > 1e6) failNifti(path, "dim", more, "values of a voxel. Is the header damaged?");
  volume.planar = volume.summary.components == 1;
  volume.summary.components *= int(more);
}

/// Millimetres per unit of the header; files without a unit are in mm, as in other NIfTI tools.
double niftiUnitMm(const std::string& path, const NiftiHeader& header, VolumeSummary& summary) {
  switch (header.xyzt_units & 7) {
    case 1:
      return 1000;
    case 2:
      return 1;
    case 3:
      return 0.001;
    case 0:
      summary.warnings.emplace_back("the header has no unit of length; mm is assumed");
      return 1;
    default:
      failNifti(path, "xyzt_units", header.xyzt_units, "which is no unit of length of NIfTI");
  }
}

/// Rotation of the qform and voxel spacing, as in the standard (method 2).
Eigen::Matrix4d niftiQform(const std::string& path, const NiftiHeader& header,
                           const Eigen::Vector3d& sides) {
  const double b = header.quatern[0], c = header.quatern[1], d = header.quatern[2];
  const double rest = 1 - (b * b + c * c + d * d);
  if (!(rest > -1e-3))  // true for NaN
    failNifti(path, "quatern_b, c, d", b * b + c * c + d * d,
              "as the sum of their squares, but must be at most 1. Is the header damaged?");
  const double a = std::sqrt(std::max(rest, 0.0));
  Eigen::Matrix3d turn;
  turn << a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c),
      2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b), 2 * (b * d - a * c),
      2 * (c * d + a * b), a * a + d * d - c * c - b * b;
  Eigen::Matrix4d ras_from_voxel = Eigen::Matrix4d::Identity();
  for (int axis = 0; axis < 3; ++axis)
    ras_from_voxel.block<3, 1>(0, axis) = turn.col(axis).normalized() * sides[axis];
  if (header.pixdim[0] < 0) ras_from_voxel.col(2) *= -1;
  for (int row = 0; row < 3; ++row) ras_from_voxel(row, 3) = header.qoffset[std::size_t(row)];
  return ras_from_voxel;
}

Eigen::Matrix4d niftiSform(const std::string& path, const NiftiHeader& header) {
  static const char* const kNames[] = {"srow_x", "srow_y", "srow_z"};
  Eigen::Matrix4d ras_from_voxel = Eigen::Matrix4d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const double value = header.srow[std::size_t(row)][std::size_t(column)];
      if (!std::isfinite(value))
        failNifti(path, kNames[row], value, "but must be four finite numbers; export it again");
      ras_from_voxel(row, column) = value;
    }
  return ras_from_voxel;
}

/// pixdim[1..3]; ones if invalid and given by the user.
Eigen::Vector3d niftiSides(const std::string& path, const NiftiHeader& header,
                           const VolumeOptions& options) {
  Eigen::Vector3d sides;
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    sides[Eigen::Index(axis) - 1] = header.pixdim[axis];
    if (std::isfinite(header.pixdim[axis]) && header.pixdim[axis] > 0) continue;
    if (!options.spacing_mm)
      failNifti(path, ("pixdim[" + std::to_string(axis) + "]").c_str(), header.pixdim[axis],
                std::string("but a voxel's sides are longer than 0; ") + kStateSpacing);
    sides[Eigen::Index(axis) - 1] = 1;
  }
  return sides;
}

Eigen::Matrix4d niftiPlace(const std::string& path, const NiftiHeader& header,
                           const VolumeOptions& options, VolumeSummary& summary) {
  const double unit_mm = niftiUnitMm(path, header, summary);
  const Eigen::Vector3d sides = niftiSides(path, header, options);
  Eigen::Matrix4d ras_from_voxel = Eigen::Matrix4d::Identity();
  summary.file_space = "RAS";
  if (header.sform_code > 0) {
    ras_from_voxel = niftiSform(path, header);
    checkAxes(path, "srow_x, srow_y, srow_z", ras_from_voxel);
    if (header.qform_code > 0 && !ras_from_voxel.isApprox(niftiQform(path, header, sides), 1e-3))
      summary.warnings.emplace_back("sform and qform disagree; the sform was taken");
  } else if (header.qform_code > 0) {
    ras_from_voxel = niftiQform(path, header, sides);
  } else {
    ras_from_voxel.topLeftCorner<3, 3>() = sides.asDiagonal();
    summary.file_space = "unknown";
    summary.warnings.emplace_back("the header has neither sform nor qform");
  }
  ras_from_voxel.topRows<3>() *= unit_mm;
  checkAxes(path, header.sform_code > 0 ? "srow_x, srow_y, srow_z" : "pixdim and qoffset",
            ras_from_voxel);
  return ras_from_voxel;
}

void takeNiftiScale(const std::string& path, const NiftiHeader& header, StoredVolume& volume) {
  if (!std::isfinite(header.scl_slope))
    failNifti(path, "scl_slope", header.scl_slope, "but must be a finite number; export it again");
  if (header.scl_slope == 0) return;  // the standard: values as stored
  if (!std::isfinite(header.scl_inter))
    failNifti(path, "scl_inter", header.scl_inter, "but must be a finite number; export it again");
  volume.slope = header.scl_slope;
  volume.intercept = header.scl_inter;
}

}  // namespace

StoredVolume readNifti(const std::string& path, const VolumeOptions& options) {
  StoredVolume volume;
  VoxelBlock block;
  volume.summary.format = "NIfTI";
  const NiftiHeader header = readNiftiHeader(path, block.big_endian);
  takeNiftiType(path, header, volume);
  takeNiftiSizes(path, header, volume);
  takeNiftiScale(path, header, volume);
  placeVolume(niftiPlace(path, header, options, volume.summary), /*spacing_said=*/true, options,
              volume.summary);
  if (!(header.vox_offset >= double(kNifti1Bytes) + 4 && header.vox_offset < 1e9 &&
        header.vox_offset == std::floor(header.vox_offset)))
    failNifti(path, "vox_offset", header.vox_offset,
              "but voxels begin at a byte from 352 on. Is the header damaged?");
  block.file = path;
  block.offset = static_cast<std::uintmax_t>(header.vox_offset);
  block.type = volume.type;
  block.components = volume.summary.components;
  block.voxels = 1;
  for (const int size : volume.summary.size_voxels) block.voxels *= size;
  const bool gzip = isGzip(path);
  volume.bytes = gzip ? readGzippedVoxels(block) : readPlainVoxels(block);
  return volume;
}

}  // namespace softscope
