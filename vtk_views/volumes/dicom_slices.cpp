#include "vtk_views/volumes/dicom_slices.h"

#include <vtkDICOMMetaData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/median.h"
#include "vtk_views/volumes/header_text.h"
#include "vtk_views/volumes/stored_volume.h"

namespace softscope {
namespace {

constexpr double kDirectionTolerance = 0.01;        // tolerance of a length or cosine
constexpr double kSameDirection = 1e-3;             // between slices; 0.06 degrees
constexpr double kEvenShare = 0.1, kEvenMm = 0.06;  // positions are often rounded to 0.1 mm
constexpr double kTiltWarnDeg = 0.5;                // between slice normal and stack direction

/// Reads tags of one frame and keeps the first fault.
class TagReader {
 public:
  TagReader(vtkDICOMMetaData& meta, DicomSlice& slice) : meta_(meta), slice_(slice) {}

  std::string text(vtkDICOMTag tag) const {
    const vtkDICOMValue& value = meta_.Get(0, slice_.frame, tag);
    return value.IsValid() ? value.AsString() : std::string();
  }
  bool has(vtkDICOMTag tag) const { return !text(tag).empty(); }

  /// Exactly `count` finite numbers; empty for other content.
  std::vector<double> numbers(vtkDICOMTag tag, std::size_t count) const {
    std::string words = text(tag);
    std::replace(words.begin(), words.end(), '\\', ' ');
    auto values = finiteNumbers(words);
    if (values.size() != count) values.clear();
    return values;
  }
  int whole(const char* name, vtkDICOMTag tag, int least, int most) {
    const auto values = numbers(tag, 1);
    const double value = values.empty() ? -1 : values[0];
    if (value >= least && value <= most && value == std::floor(value))
      return static_cast<int>(value);
    fault(name, tag,
          "a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
              ". Export the series again");
    return least;
  }
  void fault(const char* name, vtkDICOMTag tag, const std::string& expected) {
    if (!slice_.fault.empty()) return;
    char number[16];
    std::snprintf(number, sizeof number, "(%04X,%04X)", unsigned(tag.GetGroup()),
                  unsigned(tag.GetElement()));
    slice_.fault = slice_.file + ": " + name + " " + number +
                   (has(tag) ? " is " + inQuotes(text(tag)) : std::string(" is missing")) +
                   ", but must be " + expected;
  }

 private:
  vtkDICOMMetaData& meta_;
  DicomSlice& slice_;
};

void takePixelSpacing(TagReader& tags, const VolumeOptions& options, DicomSlice& slice) {
  const auto said = tags.numbers(DC::PixelSpacing, 2);
  const bool good = !said.empty() && *std::min_element(said.begin(), said.end()) > 0;
  if (good) slice.pixel_mm = {said[1], said[0]};  // between rows, then between columns
  if (!good && !options.spacing_mm)
    tags.fault("PixelSpacing", DC::PixelSpacing,
               std::string("two lengths above 0; ") + kStateSpacing);
}

void takeOrientation(TagReader& tags, DicomSlice& slice) {
  const auto said = tags.numbers(DC::ImageOrientationPatient, 6);
  if (!said.empty()) {
    slice.along_row = {said[0], said[1], said[2]};
    slice.along_column = {said[3], said[4], said[5]};
  }
  if (std::abs(slice.along_row.norm() - 1) < kDirectionTolerance &&
      std::abs(slice.along_column.norm() - 1) < kDirectionTolerance &&
      std::abs(slice.along_row.dot(slice.along_column)) < kDirectionTolerance)
    return;
  tags.fault("ImageOrientationPatient", DC::ImageOrientationPatient,
             "two directions of length 1 at a right angle: without it left and right are unknown. "
             "Export the series again");
}

void takePosition(TagReader& tags, DicomSlice& slice) {
  const auto said = tags.numbers(DC::ImagePositionPatient, 3);
  if (!said.empty()) slice.position_mm = {said[0], said[1], said[2]};
  if (said.empty())
    tags.fault("ImagePositionPatient", DC::ImagePositionPatient,
               "three numbers in mm: without it the slice has no place. Export the series again");
}

void checkRescaling(TagReader& tags) {
  const auto slope = tags.numbers(DC::RescaleSlope, 1);
  if (tags.has(DC::RescaleSlope) && (slope.empty() || slope[0] == 0))
    tags.fault("RescaleSlope", DC::RescaleSlope, "a number other than 0. Export the series again");
  if (tags.has(DC::RescaleIntercept) && tags.numbers(DC::RescaleIntercept, 1).empty())
    tags.fault("RescaleIntercept", DC::RescaleIntercept, "a number. Export the series again");
}

void takeThickness(const TagReader& tags, DicomSlice& slice) {
  for (const vtkDICOMTag tag :
       {vtkDICOMTag(DC::SpacingBetweenSlices), vtkDICOMTag(DC::SliceThickness)}) {
    const auto said = tags.numbers(tag, 1);
    if (slice.thickness_mm == 0 && !said.empty() && said[0] > 0) slice.thickness_mm = said[0];
  }
}

bool sameKind(const DicomSlice& a, const DicomSlice& b) {
  return a.columns == b.columns && a.rows == b.rows && a.bits == b.bits && a.values == b.values &&
         a.sign == b.sign &&
         (a.pixel_mm - b.pixel_mm).norm() < kSameDirection * a.pixel_mm.norm() &&
         (a.along_row - b.along_row).norm() < kSameDirection &&
         (a.along_column - b.along_column).norm() < kSameDirection;
}

std::string shortName(const DicomSlice& slice) {
  return std::filesystem::path(slice.file).filename().string();
}

/// Marks slices that differ from the largest group of equal ones.
void markDifferent(std::vector<DicomSlice>& slices) {
  const DicomSlice* most = nullptr;
  std::ptrdiff_t most_count = 0;
  std::vector<const DicomSlice*> kinds;
  for (const DicomSlice& slice : slices) {
    if (!slice.fault.empty()) continue;
    const auto alike = [&](const DicomSlice* kind) { return sameKind(*kind, slice); };
    if (std::any_of(kinds.begin(), kinds.end(), alike)) continue;
    kinds.push_back(&slice);
    const auto count = std::count_if(slices.begin(), slices.end(), [&](const DicomSlice& other) {
      return other.fault.empty() && sameKind(slice, other);
    });
    if (count > most_count) {
      most = &slice;
      most_count = count;
    }
  }
  if (most == nullptr) return;
  const DicomSlice kind = *most;
  for (DicomSlice& slice : slices)
    if (slice.fault.empty() && !sameKind(kind, slice))
      slice.fault = slice.file +
                    ": differs in size, PixelSpacing, ImageOrientationPatient or pixel format from "
                    "the most slices of its series, such as " +
                    shortName(kind);
}

/// Removes faulty slices. Throws if there is one and it is not allowed, or if none remains.
void removeFaulty(std::vector<DicomSlice>& slices, bool allowed,
                  std::vector<std::string>& warnings) {
  const auto good = [](const DicomSlice& slice) { return slice.fault.empty(); };
  const auto split = std::stable_partition(slices.begin(), slices.end(), good);
  if (split == slices.end()) return;
  const std::string count =
      std::to_string(slices.end() - split) + " of " + std::to_string(slices.size()) + " slices";
  if (split == slices.begin())
    throw InputError(split->fault + (slices.size() > 1 ? " (" + count + " are so)" : ""));
  if (!allowed)
    throw InputError(split->fault + " (" + count +
                     " don't fit; `allow_missing_slices=` leaves such slices out)");
  warnings.push_back(count + " were left out; the first: " + split->fault);
  slices.erase(split, slices.end());
}

Eigen::Vector3d normalOf(const DicomSlice& slice) {
  return slice.along_row.cross(slice.along_column).normalized();
}

/// Index of each slice in a regular stack, from the distances of neighbours.
std::vector<int> placesInStack(const std::string& path, const std::vector<DicomSlice>& slices) {
  const Eigen::Vector3d normal = normalOf(slices[0]);
  std::vector<double> gaps_mm;
  for (std::size_t i = 1; i < slices.size(); ++i) {
    gaps_mm.push_back(normal.dot(slices[i].position_mm - slices[i - 1].position_mm));
    if (gaps_mm.back() < 1e-3)
      throw InputError(path + ": " + shortName(slices[i - 1]) + " and " + shortName(slices[i]) +
                       " have the same ImagePositionPatient; a volume has one slice per position. "
                       "Give a folder with one phase, or one copy of each slice");
  }
  const double median_mm = medianOf(gaps_mm);
  std::vector<int> places{0};
  for (const double gap_mm : gaps_mm) {
    const double steps = std::min(gap_mm / median_mm, 1e6);
    places.push_back(places.back() + std::max(1, static_cast<int>(std::lround(steps))));
    if (places.back() > 4 * int(slices.size()) + 100)
      throw InputError(path + ": ImagePositionPatient scatters its slices over " +
                       std::to_string(places.back()) + " places of " + std::to_string(median_mm) +
                       " mm, but there are " + std::to_string(slices.size()) +
                       ". Export the series again");
  }
  return places;
}

/// Step between neighbouring slices of the stack.
Eigen::Vector3d stepOf(const std::string& path, const std::vector<DicomSlice>& slices, int last,
                       const VolumeOptions& options, DicomStack& stack) {
  const DicomSlice& first = slices[0];
  if (last > 0) return (slices.back().position_mm - first.position_mm) / last;
  stack.spacing_said = first.thickness_mm > 0;
  if (stack.spacing_said) return first.thickness_mm * normalOf(first);
  if (options.spacing_mm) return normalOf(first);
  throw InputError(path +
                   ": SpacingBetweenSlices (0018,0088) and SliceThickness (0018,0050) are missing, "
                   "so the distance of its slices is unknown; " +
                   kStateSpacing);
}

void checkEven(const std::vector<DicomSlice>& slices, const std::vector<int>& places,
               const Eigen::Vector3d& step_mm) {
  const double tolerance_mm = std::max(kEvenShare * step_mm.norm(), kEvenMm);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const Eigen::Vector3d expected = slices[0].position_mm + places[i] * step_mm;
    const double off_mm = (slices[i].position_mm - expected).norm();
    if (off_mm > tolerance_mm)
      throw InputError(slices[i].file + ": ImagePositionPatient (0020,0032) puts it " +
                       std::to_string(off_mm) + " mm from where an even stack of " +
                       std::to_string(step_mm.norm()) +
                       " mm has it; a volume needs even slices. Export an evenly spaced series");
  }
}

void checkMissing(const std::string& path, int missing, double step_mm, bool allowed,
                  std::vector<std::string>& warnings) {
  if (missing == 0) return;
  const std::string found = std::to_string(missing) + " slices are missing: most lie " +
                            std::to_string(step_mm) + " mm apart, some several times that";
  if (!allowed)
    throw InputError(path + ": " + found +
                     ". Copy the series again, or leave their place empty with "
                     "`allow_missing_slices=`");
  warnings.push_back(found + "; their place is empty");
}

void checkTilt(const Eigen::Vector3d& normal, const Eigen::Vector3d& step_mm,
               std::vector<std::string>& warnings) {
  const double cosine = std::min(1.0, std::abs(normal.dot(step_mm.normalized())));
  const double tilt_deg = std::acos(cosine) * 180 / M_PI;
  if (tilt_deg > kTiltWarnDeg)
    warnings.push_back("the gantry was tilted by " + std::to_string(tilt_deg) +
                       " degrees: slices are sheared against their stack");
}

/// Files in the order of their first frames, and the index of each slice among all their frames.
void numberFrames(const std::vector<DicomSlice>& slices, const std::vector<int>& places,
                  DicomStack& stack) {
  stack.stored_slices.assign(std::size_t(places.back()) + 1, -1);
  std::vector<int> first_frame;
  int frames = 0;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    auto file = std::find(stack.files.begin(), stack.files.end(), slices[i].file);
    const auto number = std::size_t(file - stack.files.begin());
    if (file == stack.files.end()) {
      stack.files.push_back(slices[i].file);
      first_frame.push_back(frames);
      frames += slices[i].frames;
    }
    stack.stored_slices[std::size_t(places[i])] = first_frame[number] + slices[i].frame;
  }
}

}  // namespace

std::vector<DicomSlice> slicesOf(const std::string& file, vtkDICOMMetaData& meta,
                                 const VolumeOptions& options) {
  DicomSlice first;
  first.file = file;
  TagReader tags(meta, first);
  if (tags.has(DC::NumberOfFrames))
    first.frames = tags.whole("NumberOfFrames", DC::NumberOfFrames, 1, 100000);
  std::vector<DicomSlice> slices(std::size_t(first.frames), first);
  for (int frame = 0; frame < first.frames; ++frame) {
    DicomSlice& slice = slices[std::size_t(frame)];
    slice.frame = frame;
    TagReader of_frame(meta, slice);
    slice.columns = of_frame.whole("Columns", DC::Columns, 1, 65535);
    slice.rows = of_frame.whole("Rows", DC::Rows, 1, 65535);
    slice.bits = of_frame.whole("BitsAllocated", DC::BitsAllocated, 1, 64);
    slice.values = of_frame.whole("SamplesPerPixel", DC::SamplesPerPixel, 1, 4);
    slice.sign = of_frame.whole("PixelRepresentation", DC::PixelRepresentation, 0, 1);
    takePixelSpacing(of_frame, options, slice);
    takeOrientation(of_frame, slice);
    takePosition(of_frame, slice);
    checkRescaling(of_frame);
    takeThickness(of_frame, slice);
  }
  return slices;
}

DicomStack stackOf(const std::string& path, std::vector<DicomSlice> slices,
                   const VolumeOptions& options) {
  DicomStack stack;
  markDifferent(slices);
  removeFaulty(slices, options.allow_missing_slices, stack.warnings);
  const Eigen::Vector3d normal = normalOf(slices[0]);
  std::stable_sort(slices.begin(), slices.end(), [&](const DicomSlice& a, const DicomSlice& b) {
    return normal.dot(a.position_mm) < normal.dot(b.position_mm);
  });
  const std::vector<int> places = placesInStack(path, slices);
  const Eigen::Vector3d step_mm = stepOf(path, slices, places.back(), options, stack);
  checkEven(slices, places, step_mm);
  checkMissing(path, places.back() + 1 - int(slices.size()), step_mm.norm(),
               options.allow_missing_slices, stack.warnings);
  checkTilt(normal, step_mm, stack.warnings);
  numberFrames(slices, places, stack);
  stack.lps_from_voxel.block<3, 1>(0, 0) = slices[0].along_row.normalized() * slices[0].pixel_mm[0];
  stack.lps_from_voxel.block<3, 1>(0, 1) =
      slices[0].along_column.normalized() * slices[0].pixel_mm[1];
  stack.lps_from_voxel.block<3, 1>(0, 2) = step_mm;
  stack.lps_from_voxel.block<3, 1>(0, 3) = slices[0].position_mm;
  checkAxes(path, "PixelSpacing, ImageOrientationPatient, ImagePositionPatient",
            stack.lps_from_voxel);
  return stack;
}

}  // namespace softscope
