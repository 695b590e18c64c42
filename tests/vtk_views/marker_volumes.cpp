#include "tests/vtk_views/marker_volumes.h"

#include <vtkDICOMCTGenerator.h>
#include <vtkDICOMMetaData.h>
#include <vtkDICOMWriter.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <sstream>

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

constexpr int kSize[3] = {24, 20, 16};
const Eigen::Vector3d kSpacing(1.5, 2, 2.5);

/// Where voxels lie: axes from `turn`, such that the volume's middle is at the same place in all.
Eigen::Matrix4d lpsFromVoxel(const Eigen::Matrix3d& turn) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = turn * kSpacing.asDiagonal();
  const Eigen::Vector3d middle(kSize[0] / 2, kSize[1] / 2, kSize[2] / 2);
  matrix.topRightCorner<3, 1>() =
      Eigen::Vector3d(30, -50, 700) - matrix.topLeftCorner<3, 3>() * middle;
  return matrix;
}

/// Each mark is a ball of 4 mm: it survives any order and turn of the voxels.
std::vector<short> voxels(const Eigen::Matrix4d& lps_from_voxel) {
  std::vector<short> values;
  for (int k = 0; k < kSize[2]; ++k)
    for (int j = 0; j < kSize[1]; ++j)
      for (int i = 0; i < kSize[0]; ++i) {
        const Eigen::Vector3d p = (lps_from_voxel * Eigen::Vector4d(i, j, k, 1)).head<3>();
        short value = -1000;
        for (const Mark& mark : marks())
          if ((p - mark.lps_mm).norm() < 4) value = static_cast<short>(mark.value);
        values.push_back(value);
      }
  return values;
}

std::string bytesOf(const std::vector<short>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(short)};
}

std::string triple(const Eigen::Vector3d& v, char separator) {
  std::ostringstream text;
  text.precision(12);
  text << v.x() << separator << v.y() << separator << v.z();
  return text.str();
}

/// LPS turned into the space that the header will name.
Eigen::Matrix4d inRas(Eigen::Matrix4d lps_from_voxel) {
  lps_from_voxel.topRows<2>() *= -1;
  return lps_from_voxel;
}

void writeNrrd(const fs::path& path, const Eigen::Matrix4d& lps_from_voxel, bool ras) {
  const Eigen::Matrix4d m = ras ? inRas(lps_from_voxel) : lps_from_voxel;
  std::ofstream file(path, std::ios::binary);
  file << "NRRD0004\ntype: short\ndimension: 3\nspace: "
       << (ras ? "right-anterior-superior" : "left-posterior-superior")
       << "\nsizes: 24 20 16\nspace directions:";
  for (int axis = 0; axis < 3; ++axis) file << " (" << triple(m.block<3, 1>(0, axis), ',') << ")";
  file << "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: ("
       << triple(m.block<3, 1>(0, 3), ',') << ")\n\n"
       << bytesOf(voxels(lps_from_voxel));
}

void writeMetaImage(const fs::path& path, const Eigen::Matrix4d& m, const Eigen::Matrix3d& turn) {
  std::ofstream file(path, std::ios::binary);
  file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
       << "TransformMatrix =";
  for (int axis = 0; axis < 3; ++axis) file << " " << triple(turn.col(axis), ' ');
  file << "\nOffset = " << triple(m.block<3, 1>(0, 3), ' ')
       << "\nElementSpacing = " << triple(kSpacing, ' ')
       << "\nDimSize = 24 20 16\nElementType = MET_SHORT\nElementDataFile = LOCAL\n"
       << bytesOf(voxels(m));
}

vtkSmartPointer<vtkImageData> imageOf(const Eigen::Matrix4d& lps_from_voxel) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(kSize);
  image->SetSpacing(kSpacing.data());
  image->AllocateScalars(VTK_SHORT, 1);
  const std::vector<short> values = voxels(lps_from_voxel);
  std::copy(values.begin(), values.end(), static_cast<short*>(image->GetScalarPointer()));
  return image;
}

/// VTK's matrices lead from unscaled voxels.
vtkSmartPointer<vtkMatrix4x4> unscaled(const Eigen::Matrix4d& matrix) {
  auto result = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      result->SetElement(row, column, matrix(row, column) / (column < 3 ? kSpacing[column] : 1.0));
  return result;
}

void writeNifti(const fs::path& path, const Eigen::Matrix4d& lps_from_voxel, bool sform) {
  vtkNew<vtkNIFTIImageWriter> writer;
  const auto ras = unscaled(inRas(lps_from_voxel));
  writer->SetInputData(imageOf(lps_from_voxel));
  if (sform)
    writer->SetSFormMatrix(ras);
  else
    writer->SetQFormMatrix(ras);
  writer->SetFileName(path.c_str());
  writer->Write();
}

void writeDicom(const fs::path& folder, const Eigen::Matrix4d& lps_from_voxel) {
  fs::create_directories(folder);
  vtkNew<vtkDICOMMetaData> meta;
  meta->Set(DC::Modality, "CT");
  vtkNew<vtkDICOMCTGenerator> generator;
  vtkNew<vtkDICOMWriter> writer;
  writer->SetInputData(imageOf(lps_from_voxel));
  writer->SetMetaData(meta);
  writer->SetGenerator(generator);
  writer->SetMemoryRowOrderToFileNative();
  writer->SetPatientMatrix(unscaled(lps_from_voxel));
  writer->SetFilePrefix(folder.c_str());
  writer->SetFilePattern("%s/slice%d");
  writer->Write();
}

}  // namespace

std::vector<Mark> marks() {
  return {{{41, -61, 712}, 500}, {{22, -44, 708}, 1000}, {{36, -42, 690}, 1500}};
}

std::vector<MarkerFile> writeMarkerVolumes(const fs::path& folder) {
  Eigen::Matrix3d flipped = Eigen::Matrix3d::Zero();  // i to the front, j right, k to the feet
  flipped(1, 0) = -1;
  flipped(0, 1) = -1;
  flipped(2, 2) = -1;
  const Eigen::Matrix3d oblique =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<MarkerFile> files;
  for (const auto& [name, turn] :
       {std::pair<std::string, Eigen::Matrix3d>{"flipped", flipped}, {"oblique", oblique}}) {
    const Eigen::Matrix4d m = lpsFromVoxel(turn);
    const auto add = [&files, &folder, suffix = name](const std::string& what,
                                                      const std::string& ending) {
      files.push_back({what + ", " + suffix, folder / (suffix + ending)});
      return files.back().path;
    };
    writeNrrd(add("NRRD in LPS", "_lps.nrrd"), m, false);
    writeNrrd(add("NRRD in RAS", "_ras.nrrd"), m, true);
    writeMetaImage(add("MetaImage", ".mha"), m, turn);
    writeNifti(add("NIfTI with qform", "_q.nii"), m, false);
    writeNifti(add("NIfTI with sform", "_s.nii.gz"), m, true);
    writeDicom(add("DICOM", "_dicom"), m);
  }
  return files;
}

}  // namespace softscope::test
