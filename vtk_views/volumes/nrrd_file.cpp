// vtk_views/volumes/nrrd_file.cpp: reader of NRRD (.nrrd, .nhdr).
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/error.h"
#include "vtk_views/volumes/header_text.h"
#include "vtk_views/volumes/volume_formats.h"
#include "vtk_views/volumes/voxel_bytes.h"

namespace softscope {
namespace {

constexpr std::int64_t kMostNrrdSize = std::int64_t{1} << 30;

/// Every field of the format; others must be notes, `key:=value`.
const std::vector<std::string> kNrrdFields{"axis maxs",
                                           "axis mins",
                                           "axismaxs",
                                           "axismins",
                                           "block size",
                                           "blocksize",
                                           "byte skip",
                                           "byteskip",
                                           "centerings",
                                           "centers",
                                           "content",
                                           "data file",
                                           "datafile",
                                           "dimension",
                                           "encoding",
                                           "endian",
                                           "kinds",
                                           "labels",
                                           "line skip",
                                           "lineskip",
                                           "max",
                                           "min",
                                           "measurement frame",
                                           "number",
                                           "old max",
                                           "old min",
                                           "oldmax",
                                           "oldmin",
                                           "sample units",
                                           "sampleunits",
                                           "sizes",
                                           "space",
                                           "space dimension",
                                           "space directions",
                                           "space origin",
                                           "space units",
                                           "spacings",
                                           "thicknesses",
                                           "type",
                                           "units"};

VoxelType nrrdType(const HeaderText& header) {
  using Names = std::vector<const char*>;
  static const std::pair<Names, VoxelType> kTypes[] = {
      {{"signed char", "int8", "int8_t"}, VoxelType::kInt8},
      {{"uchar", "unsigned char", "uint8", "uint8_t"}, VoxelType::kUint8},
      {{"short", "short int", "signed short", "signed short int", "int16", "int16_t"},
       VoxelType::kInt16},
      {{"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"},
       VoxelType::kUint16},
      {{"int", "signed int", "int32", "int32_t"}, VoxelType::kInt32},
      {{"uint", "unsigned int", "uint32", "uint32_t"}, VoxelType::kUint32},
      {{"longlong", "long long", "long long int", "signed long long", "signed long long int",
        "int64", "int64_t"},
       VoxelType::kInt64},
      {{"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"},
       VoxelType::kUint64},
      {{"float"}, VoxelType::kFloat32},
      {{"double"}, VoxelType::kFloat64}};
  const std::string& name = header.text("type");
  for (const auto& [names, type] : kTypes)
    if (std::find(names.begin(), names.end(), name) != names.end()) return type;
  header.fail("type", "but must be a type of numbers: short, uchar, float …");
}

/// "left-posterior-superior" becomes "LPS"; short forms are kept; other spaces are "unknown".
std::string shortSpace(std::string name) {
  for (char& c : name) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (name.empty()) return "unknown";
  std::string letters(1, char(std::toupper(static_cast<unsigned char>(name[0]))));
  for (std::size_t i = 0; i + 1 < name.size(); ++i)
    if (name[i] == '-') letters += char(std::toupper(static_cast<unsigned char>(name[i + 1])));
  if (letters.size() != 3) letters = name;
  for (char& c : letters) c = char(std::toupper(static_cast<unsigned char>(c)));
  const auto among = [&](std::size_t at, const char* two) {
    return letters.size() == 3 && (letters[at] == two[0] || letters[at] == two[1]);
  };
  return among(0, "LR") && among(1, "AP") && among(2, "SI") ? letters : "unknown";
}

double millimetresIn(const HeaderText& header, const std::string& key, const std::string& unit) {
  static const std::pair<const char*, double> kUnits[] = {
      {"mm", 1},         {"millimeter", 1},  {"millimetre", 1},   {"millimeters", 1},
      {"m", 1000},       {"meter", 1000},    {"metre", 1000},     {"meters", 1000},
      {"cm", 10},        {"centimeter", 10}, {"centimetre", 10},  {"um", 0.001},
      {"micron", 0.001}, {"microns", 0.001}, {"\xc2\xb5m", 0.001}};
  for (const auto& [name, mm] : kUnits)
    if (unit == name) return mm;
  header.fail(key, "but each must be mm, cm, m or um");
}

/// Entries of `"mm" "mm" "mm"`, one per space axis, as factors; ones if absent.
Eigen::Vector3d nrrdUnitsMm(const HeaderText& header) {
  Eigen::Vector3d units_mm(1, 1, 1);
  if (!header.has("space units")) return units_mm;
  std::string text = header.text("space units");
  int count = 0;
  for (auto open = text.find('"'); open != std::string::npos; ++count) {
    const auto close = text.find('"', open + 1);
    if (close == std::string::npos || count == 3) header.fail("space units", "but needs 3 units");
    units_mm[count] = millimetresIn(header, "space units", text.substr(open + 1, close - open - 1));
    open = text.find('"', close + 1);
  }
  if (count != 3) header.fail("space units", "but needs 3 units in quotes");
  return units_mm;
}

/// "(1,0,0) none (0,1,0)": one entry per axis,
/// empty for "none". Throws for other content.
std::vector<std::optional<Eigen::Vector3d>> vectorsOf(const HeaderText& header,
                                                      const std::string& key) {
  const std::string& text = header.text(key);
  std::vector<std::optional<Eigen::Vector3d>> vectors;
  for (std::size_t at = 0; (at = text.find_first_not_of(' ', at)) != std::string::npos;) {
    if (text.compare(at, 4, "none") == 0) {
      vectors.emplace_back();
      at += 4;
      continue;
    }
    const auto close = text.find(')', at);
    if (text[at] != '(' || close == std::string::npos)
      header.fail(key, "but must be vectors in brackets, (1,0,0), or none");
    const auto numbers = finiteNumbers(text.substr(at + 1, close - at - 1));
    if (numbers.size() != 3) header.fail(key, "but each vector must hold 3 finite numbers");
    vectors.emplace_back(Eigen::Vector3d(numbers[0], numbers[1], numbers[2]));
    at = close + 1;
  }
  return vectors;
}

/// Axes of the volume, and the optional axis of values per voxel.
struct NrrdAxes {
  std::vector<std::size_t> spatial;
  std::optional<std::size_t> components;
};

NrrdAxes nrrdAxes(const HeaderText& header, std::size_t dimension) {
  NrrdAxes axes;
  const bool directed = header.has("space directions");
  const auto directions =
      directed ? vectorsOf(header, "space directions")
               : std::vector<std::optional<Eigen::Vector3d>>(dimension, Eigen::Vector3d::Zero());
  if (directions.size() != dimension)
    header.fail("space directions", "but needs one entry per axis, " + std::to_string(dimension));
  for (std::size_t axis = 0; axis < dimension; ++axis)
    if (directions[axis])
      axes.spatial.push_back(axis);
    else
      axes.components = axis;
  if (axes.spatial.size() != 3 || (axes.components && *axes.components % 3 != 0))
    header.fail(directed ? "space directions" : "dimension",
                "but a volume has 3 axes in space, and values of a voxel lie before or after them");
  return axes;
}

/// Columns: direction of each axis times its spacing, mm. Without
/// directions, the axes are those of the space, whose name is then unknown.
Eigen::Matrix4d nrrdPlace(const HeaderText& header, const NrrdAxes& axes, std::size_t dimension,
                          const VolumeOptions& options, VolumeSummary& summary) {
  Eigen::Matrix4d space_from_voxel = Eigen::Matrix4d::Identity();
  summary.file_space = shortSpace(header.textOr("space", ""));
  const Eigen::Vector3d units_mm = nrrdUnitsMm(header);
  if (header.has("space directions")) {
    const auto directions = vectorsOf(header, "space directions");
    for (int i = 0; i < 3; ++i)
      space_from_voxel.block<3, 1>(0, i) =
          directions[axes.spatial[std::size_t(i)]]->cwiseProduct(units_mm);
  } else {
    summary.file_space = "unknown";
    if (!header.has("spacings") && !options.spacing_mm)
      throw InputError(header.path() +
                       ": the header has neither `space directions` nor "
                       "`spacings`, so the size of a voxel is unknown; " +
                       kStateSpacing);
    if (header.has("units")) header.fail("units", "which softscope reads as `space units` alone");
    const auto lengths = header.has("spacings") ? header.numbers("spacings", dimension)
                                                : std::vector<double>(dimension, 1.0);
    for (int i = 0; i < 3; ++i) space_from_voxel(i, i) = lengths[axes.spatial[std::size_t(i)]];
  }
  if (header.has("space origin")) {
    const auto origin = vectorsOf(header, "space origin");
    if (origin.size() != 1 || !origin[0]) header.fail("space origin", "but must be one vector");
    space_from_voxel.topRightCorner<3, 1>() = origin[0]->cwiseProduct(units_mm);
  } else {
    summary.warnings.emplace_back(
        "the header has no space origin: the first voxel was put at 0, 0, 0");
  }
  checkAxes(header.path(), "space directions, spacings and space origin", space_from_voxel);
  return space_from_voxel;
}

std::string nrrdVoxels(const HeaderText& header, VoxelBlock block) {
  block.file = header.path();
  block.offset = header.endOffset();
  if (const std::string key = header.firstOf({"data file", "datafile"}); !key.empty()) {
    const std::string& name = header.text(key);
    if (name.empty() || name.compare(0, 4, "LIST") == 0 || name.find('%') != std::string::npos)
      header.fail(key, "but softscope reads one file; join the slices to one file");
    block.file = block.file.parent_path() / name;
    block.offset = 0;
  }
  if (const std::string key = header.firstOf({"line skip", "lineskip"}); !key.empty())
    header.wholes(key, 1, 0, 0);
  if (const std::string key = header.firstOf({"byte skip", "byteskip"}); !key.empty())
    block.offset += static_cast<std::uintmax_t>(header.wholes(key, 1, 0, kMostNrrdSize)[0]);
  if (bytesOf(block.type) > 1) {
    const std::string& order = header.text("endian");
    if (order != "little" && order != "big") header.fail("endian", "but must be little or big");
    block.big_endian = order == "big";
  }
  const std::string& encoding = header.text("encoding");
  if (encoding == "raw") return readPlainVoxels(block);
  if (encoding == "gzip" || encoding == "gz") return readPackedVoxels(block);
  header.fail("encoding", "but softscope reads raw and gzip; save it so");
}

}  // namespace

StoredVolume readNrrd(const std::string& path, const VolumeOptions& options) {
  const HeaderText header = HeaderText::readNrrd(path);
  header.requireKnownKeys(kNrrdFields);
  const auto dimension = static_cast<std::size_t>(header.wholes("dimension", 1, 3, 4)[0]);
  const auto sizes = header.wholes("sizes", dimension, 1, kMostNrrdSize);
  StoredVolume volume;
  VolumeSummary& summary = volume.summary;
  summary.format = "NRRD";
  VoxelBlock block;
  block.type = volume.type = nrrdType(header);
  header.text("encoding");
  const NrrdAxes axes = nrrdAxes(header, dimension);
  block.voxels = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    summary.size_voxels[i] = static_cast<int>(sizes[axes.spatial[i]]);
    block.voxels *= summary.size_voxels[i];
  }
  if (axes.components) summary.components = static_cast<int>(sizes[*axes.components]);
  block.components = summary.components;
  volume.planar = axes.components == std::size_t{3};
  const bool said = header.has("space directions") || header.has("spacings");
  placeVolume(nrrdPlace(header, axes, dimension, options, summary), said, options, summary);
  volume.bytes = nrrdVoxels(header, block);
  return volume;
}

}  // namespace softscope
